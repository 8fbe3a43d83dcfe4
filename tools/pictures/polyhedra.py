"""Bodies that are not spheres: their faces in the world, by arrays over all bodies. Layout of /shapes:
io/results/flat_shape_fields.hpp."""
import numpy as np


class Shapes:
    """The shapes of a run, their faces cut into triangles."""

    def __init__(self, group):
        def read(name):
            return group[name][...]

        self.vertex, self.normal = read("vertex"), read("face_normal")
        self.volume = read("volume")
        self.count, corner = read("vertices").astype(int), read("corner").astype(int)
        self.first = before(self.count)
        faces, sides = read("faces").astype(int), read("sides").astype(int)
        # Triangle k of a face has its corners 0, k + 1, k + 2.
        of_face = np.repeat(np.arange(len(sides)), sides - 2)
        k = np.arange(len(of_face)) - np.repeat(before(sides - 2), sides - 2)
        begin = before(sides)[of_face]
        self.triangle = np.column_stack([corner[begin], corner[begin + k + 1], corner[begin + k + 2]])
        self.face = of_face
        of_shape = np.repeat(np.arange(len(faces)), faces)  # of each face
        self.triangles = np.bincount(of_shape[of_face], minlength=len(faces))
        self.first_triangle = before(self.triangles)


def before(counts):
    """Sums of what comes before each."""
    return np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(int) if len(counts) else np.zeros(0, dtype=int)


def spread(first, count):
    """first[0], first[0] + 1, ... count[0] numbers, then those of the next."""
    return np.arange(count.sum()) + np.repeat(first - before(count), count)


def rotate(quaternion, vector):
    """Unit quaternions w, x, y, z (n, 4) on vectors (n, 3)."""
    w, u = quaternion[:, :1], quaternion[:, 1:]
    twice = 2.0 * np.cross(u, vector)
    return vector + w * twice + np.cross(u, twice)


def vertices_of(snapshot, bodies):
    """Vertices in the world (m, 3) and the body of each."""
    shapes, shape = snapshot.shapes, snapshot.shape[bodies]
    body = np.repeat(bodies, shapes.count[shape])
    vertex = shapes.vertex[spread(shapes.first[shape], shapes.count[shape])]
    return snapshot.position[body] + rotate(snapshot.orientation[body], vertex), body


class Faces:
    """The triangles that face the eye: corners in the world (n, 3, 3), unit normals (n, 3), body and face of each."""

    def __init__(self, snapshot, bodies, camera):
        shapes, shape = snapshot.shapes, snapshot.shape[bodies]
        count = shapes.triangles[shape]
        body = np.repeat(bodies, count)
        triangle = spread(shapes.first_triangle[shape], count)
        normal = rotate(snapshot.orientation[body], shapes.normal[shapes.face[triangle]])
        start = self.corners(snapshot, body, shapes.triangle[triangle, 0])
        facing = np.einsum("ij,ij->i", normal, camera.directions_to_eye(start)) > 0.0
        self.body, triangle, self.normal = body[facing], triangle[facing], normal[facing]
        self.corner = np.stack([start[facing]] + [self.corners(snapshot, self.body, shapes.triangle[triangle, k])
                                                  for k in (1, 2)], axis=1)
        # A number for each face of each body, so that triangles of one face are one.
        change = np.ones(len(triangle), dtype=bool)
        face = shapes.face[triangle]
        change[1:] = (self.body[1:] != self.body[:-1]) | (face[1:] != face[:-1])
        self.face = np.cumsum(change) - 1

    @staticmethod
    def corners(snapshot, body, local):
        vertex = snapshot.shapes.vertex[snapshot.shapes.first[snapshot.shape[body]] + local]
        return snapshot.position[body] + rotate(snapshot.orientation[body], vertex)
