// Mesh files in every format, and what is wrong with bad ones.
#include "scenarios/shapes/mesh_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "scenarios/shapes/solids.hpp"

namespace scree::scenarios {
namespace {

// A file in a folder of its own, gone with the test.
class File {
  public:
    File(const std::string& name, const std::function<void(std::ostream&)>& write)
        : folder_(std::filesystem::temp_directory_path() /
                  (std::string("scree_mesh_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
                   std::to_string(getpid()))),
          path_((folder_ / name).string()) {
        std::filesystem::create_directories(folder_);
        std::ofstream out(path_, std::ios::binary);
        write(out);
    }
    ~File() { std::filesystem::remove_all(folder_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::filesystem::path folder_;
    std::string path_;
};

Polyhedron triangles_of(const Polyhedron& body) {
    Polyhedron cut{body.vertex, {}};
    for (const auto& loop : body.face)
        for (std::size_t k = 2; k < loop.size(); ++k) cut.face.push_back({loop[0], loop[k - 1], loop[k]});
    return cut;
}

void write_numbers(std::ostream& out, const Vec3& x) {
    out << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
}
void write_off(std::ostream& out, const Polyhedron& body) {
    out.precision(17);
    out << "OFF\n" << body.vertex.size() << ' ' << body.face.size() << " 0\n";
    for (const Vec3& x : body.vertex) write_numbers(out, x);
    for (const auto& loop : body.face) {
        out << loop.size();
        for (const auto v : loop) out << ' ' << v;
        out << '\n';
    }
}
void write_obj(std::ostream& out, const Polyhedron& body) {
    out.precision(9);
    out << "# a body\no body\n";
    for (const Vec3& x : body.vertex) {
        out << "vn 0 0 1\nv ";
        write_numbers(out, x);
    }
    for (const auto& loop : body.face) {
        out << 'f';
        for (const auto v : loop) out << ' ' << v + 1 << "//" << v + 1;
        out << '\n';
    }
}
void write_stl_text(std::ostream& out, const Polyhedron& body) {
    out.precision(7);
    out << "solid body\n";
    const Polyhedron cut = triangles_of(body);
    for (const auto& loop : cut.face) {
        out << "facet normal 0 0 0\nouter loop\n";
        for (const auto v : loop) {
            out << "vertex ";
            write_numbers(out, cut.vertex[v]);
        }
        out << "endloop\nendfacet\n";
    }
    out << "endsolid body\n";
}
void write_float(std::ostream& out, double x) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(x));
    for (int k = 0; k < 4; ++k) out.put(static_cast<char>(bits >> (8 * k) & 0xff));
}
void write_stl_binary(std::ostream& out, const Polyhedron& body) {
    const Polyhedron cut = triangles_of(body);
    out << std::string(80, ' ');
    for (int k = 0; k < 4; ++k) out.put(static_cast<char>(cut.face.size() >> (8 * k) & 0xff));
    for (const auto& loop : cut.face) {
        for (int k = 0; k < 3; ++k) write_float(out, 0.0);
        for (const auto v : loop)
            for (int i = 0; i < 3; ++i) write_float(out, cut.vertex[v][i]);
        out.put(0).put(0);
    }
}
void write_ply(std::ostream& out, const Polyhedron& body) {
    out.precision(9);
    out << "ply\nformat ascii 1.0\nelement vertex " << body.vertex.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << body.face.size()
        << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3& x : body.vertex) write_numbers(out, x);
    for (const auto& loop : body.face) {
        out << loop.size();
        for (const auto v : loop) out << ' ' << v;
        out << '\n';
    }
}

// A body with nothing along the axes.
Polyhedron turned(PlacedShape placed) {
    placed.rotation = Quat(0.5, -0.3, 0.7, 0.4).normalized() * placed.rotation;
    placed.centre = Vec3(0.3, -0.2, 0.5);
    return polyhedron_of(placed);
}

TEST(MeshFile, EveryFormatGivesTheSameBody) {
    const auto block = eota_block({2.0, 2.0, 1.0});
    const Polyhedron body = turned(block);
    using Write = void (*)(std::ostream&, const Polyhedron&);
    for (const auto& [name, write, accuracy] : {std::tuple<const char*, Write, double>{"a.off", write_off, 1e-14},
                                                {"a.obj", write_obj, 1e-8},
                                                {"a.stl", write_stl_text, 1e-6},
                                                {"b.STL", write_stl_binary, 1e-6},
                                                {"a.ply", write_ply, 1e-6}}) {
        const File file(name, [&, w = write](std::ostream& out) { w(out, body); });
        for (const bool hull : {false, true}) {
            const auto placed = read_mesh(file.path(), {.scale = 1.0, .hull = hull});
            EXPECT_EQ(placed.shape.vertex.size(), 24U) << name;
            EXPECT_EQ(placed.shape.face.size(), 26U) << name;
            EXPECT_NEAR(placed.shape.volume / block.shape.volume, 1.0, accuracy) << name;
            EXPECT_LT((placed.shape.inertia - block.shape.inertia).norm(), accuracy) << name;
            EXPECT_LT((placed.centre - Vec3(0.3, -0.2, 0.5)).norm(), accuracy) << name;
        }
        EXPECT_NEAR(read_mesh(file.path(), {.scale = 1e-3, .hull = false}).shape.volume / block.shape.volume, 1e-9,
                    1e-9 * accuracy);
    }
}

void expect_fault(const Polyhedron& body, ShapeFault fault, const std::string& message) {
    const File file("body.off", [&](std::ostream& out) { write_off(out, body); });
    try {
        read_mesh(file.path());
        ADD_FAILURE() << "this was taken for a body: " << message;
    } catch (const ShapeError& error) {
        const std::string what = error.what();
        EXPECT_EQ(error.fault(), fault) << what;
        EXPECT_EQ(what.find(file.path() + ": "), 0U) << what;
        EXPECT_NE(what.find(message), std::string::npos) << what;
    }
}

TEST(MeshFile, SaysWhatIsWrongWithASurface) {
    const Polyhedron good = triangles_of(turned(box({1, 2, 3})));
    Polyhedron body = good;
    body.face.pop_back();
    expect_fault(body, ShapeFault::not_closed, "3 of its 18 edges belong to one face only, where 2 are expected");
    body = good;
    std::swap(body.face[4][0], body.face[4][1]);
    expect_fault(body, ShapeFault::not_oriented, "one of them is inside out");
    body = good;
    for (auto& loop : body.face) std::swap(loop[0], loop[1]);
    expect_fault(body, ShapeFault::not_oriented, "inside out: its volume is -6 m3");
    body = good;
    for (const Vec3& x : good.vertex) body.vertex.push_back(x + Vec3(9, 0, 0));
    for (const auto& loop : good.face) body.face.push_back({loop[0] + 8, loop[1] + 8, loop[2] + 8});
    expect_fault(body, ShapeFault::not_connected, "make up 2 separate surfaces");
    body = good;
    for (Vec3& x : body.vertex) x.z() = 0.0;
    expect_fault(body, ShapeFault::no_volume, "no volume");
    body = good;
    body.vertex[1] = body.vertex[0];
    expect_fault(body, ShapeFault::bad_face, "more than once");
}

// A block with a step: eight corners of a box, one edge of the top pushed down to half height.
Polyhedron stairs() {
    Polyhedron body;
    for (const double y : {0.0, 1.0})
        for (const auto& [x, z] : {std::pair{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}, {1.0, 2.0}, {0.0, 2.0}})
            body.vertex.emplace_back(x, y, z);
    body.face = {{0, 1, 2, 3}, {0, 3, 4, 5}, {9, 8, 7, 6}, {11, 10, 9, 6}};
    for (std::uint32_t k = 0; k < 6; ++k) {
        const std::uint32_t n = (k + 1) % 6;
        body.face.push_back({n, k, k + 6, n + 6});
    }
    return body;
}

TEST(MeshFile, NonConvexBodiesNeedTheHull) {
    const Polyhedron body = stairs();
    expect_fault(body, ShapeFault::not_convex, "with `hull: true` its convex hull is taken");
    const File file("stairs.off", [&](std::ostream& out) { write_off(out, body); });
    const auto hull = read_mesh(file.path(), {.scale = 1.0, .hull = true});
    EXPECT_NEAR(hull.shape.volume, 3.5, 1e-14);
    EXPECT_EQ(hull.shape.face.size(), 7U);
}

TEST(MeshFile, SurfacesThatCrossThemselves) {
    const Polyhedron body = triangles_of(turned(box({1, 2, 3})));
    const Vec3 corner = body.vertex[0];  // and its three neighbours along the edges, which are 1, 2 and 3 long
    std::array<Vec3, 3> edge = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    for (const Vec3& x : body.vertex)
        for (int k = 0; k < 3; ++k)
            if (std::abs((x - corner).norm() - (k + 1.0)) < 1e-9) edge[static_cast<std::size_t>(k)] = x - corner;
    for (const double far :
         {1.5, 2.5}) {  // through the opposite face and out: what is left of the volume is 1 or -1 m3
        Polyhedron crossed = body;
        crossed.vertex[0] += far * edge[0] + 0.5 * edge[1] + 0.5 * edge[2];
        expect_fault(crossed, ShapeFault::self_crossing, "crosses itself in");
    }
}

void expect_unreadable(const std::string& name, const std::string& text, const std::string& message) {
    const File file(name, [&](std::ostream& out) { out << text; });
    try {
        read_mesh(file.path());
        ADD_FAILURE() << "this was read: " << text;
    } catch (const IoError& error) {
        EXPECT_NE(std::string(error.what()).find(file.path() + ":"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
}

TEST(MeshFile, SaysWhereItCannotBeRead) {
    EXPECT_THROW(read_mesh("/nowhere/body.off"), IoError);
    EXPECT_THROW(read_mesh(std::filesystem::temp_directory_path().string()), IoError);
    expect_unreadable("a.xyz", "", ".off, .obj, .stl or .ply is expected");
    expect_unreadable("a", "", ".off, .obj, .stl or .ply is expected");
    expect_unreadable("a.off", "", ":1: the word OFF is expected first");
    expect_unreadable("a.off", "COFF\n1 1 1\n", ":1: the word OFF is expected first");
    expect_unreadable("a.off", "OFF\n# nothing\n4 x 0\n", ":3: 'x' where the number of faces is expected");
    expect_unreadable("a.off", "OFF\n99999999999999 3 0\n0 0 0\n", ":4: the file ends too early");
    expect_unreadable("a.off", "OFF\n1 1 0\n0 0 0,5\n", ":3: '0,5' where a coordinate is expected, a number");
    expect_unreadable("a.off", "OFF\n2 1 0\n0 0 0\n1 1 1\n3 0 1 2\n",
                      ":5: a face names vertex 2, counted from 0; there are 2");
    expect_unreadable("a.obj", "v 0 0 0\nv 0 1\n", ":2: '' where a coordinate is expected");
    expect_unreadable("a.obj", "v 0 0 0\nf 1/1 2/2 3/3\n", ":2: a face names vertex 1, counted from 0; there are 1");
    expect_unreadable("a.obj", "v 0 0 0\nf -2\n", ":2: a face names vertex -1");
    expect_unreadable("a.stl", "nothing", "7 bytes are too few");
    expect_unreadable("a.stl", std::string(100, '\1'),
                      "a binary STL file of 16843009 triangles has 842150534 bytes, but there are 100");
    expect_unreadable("a.stl", "solid a\nfacet normal 0 0 0\nouter loop\nvertex 1 2\nendloop",
                      ":5: 'endloop' where a coordinate");
    expect_unreadable("a.stl", "solid a\n", ":2: the file ends too early");
    expect_unreadable("a.ply", "plx\n", ":1: the word ply is expected first");
    expect_unreadable("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty real x\n",
                      ":4: 'real' where a type is expected");
    expect_unreadable("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nend_header\n1\n",
                      ":7: the file ends");
    expect_unreadable("a.ply",
                      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nend_header\n1234",
                      "the file ends");
    expect_unreadable(
        "a.ply", "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\nend_header\n3 0 1 2\n",
        ":6: a face names vertex 0, counted from 0; there are 0");
}

TEST(MeshFile, OffWithColoursAndObjCountedBackwards) {
    const File off("a.off", [](std::ostream& out) {
        out << "OFF  # a comment\n\n4 4 6\n0 0 0\n 1 0 0\n+0 1 0\n0 0 1e0\n3 0 2 1 255 0 0\n3 0 1 3\n3 1 2 3\n3 0 3 2 "
               "1\n";
    });
    EXPECT_NEAR(read_mesh(off.path()).shape.volume, 1.0 / 6.0, 1e-15);
    const File obj("a.obj", [](std::ostream& out) {
        out << "v 0 0 0\nv 1 0 0 1.0\nv 0 1 0\nv 0 0 1\ng a\nf -4 -2 -3\nf 1/7/8 2//5 4\nf 2 3 4\nf 1 4 3\n";
    });
    EXPECT_NEAR(read_mesh(obj.path()).shape.volume, 1.0 / 6.0, 1e-15);
}

TEST(MeshFile, BinaryPlyOfEitherByteOrder) {
    const Polyhedron body = turned(box({1, 2, 3}));
    for (const bool big : {false, true}) {
        const File file("a.ply", [&](std::ostream& out) {
            const auto put = [&](std::uint64_t bits, int bytes) {
                for (int k = 0; k < bytes; ++k)
                    out.put(static_cast<char>(bits >> 8 * (big ? bytes - 1 - k : k) & 0xff));
            };
            out << "ply\nformat binary_" << (big ? "big" : "little") << "_endian 1.0\ncomment none\nelement vertex 8\n"
                << "property uchar red\nproperty double x\nproperty double y\nproperty double z\nelement face 6\n"
                << "property short tag\nproperty list ushort int32 vertex_indices\nend_header\n";
            for (const Vec3& x : body.vertex) {
                put(200, 1);
                for (int i = 0; i < 3; ++i) put(std::bit_cast<std::uint64_t>(x[i]), 8);
            }
            for (const auto& loop : body.face) {
                put(0xfffe, 2);
                put(loop.size(), 2);
                for (const auto v : loop) put(v, 4);
            }
        });
        EXPECT_NEAR(read_mesh(file.path()).shape.volume, 6.0, 1e-14);
    }
}

// Cut or garbled anywhere, a file is read as a body or refused: nothing else happens.
TEST(MeshFile, GarbledFilesAreRefusedOrRead) {
    const Polyhedron body = turned(box({1, 2, 3}));
    using Write = void (*)(std::ostream&, const Polyhedron&);
    int refused = 0;
    for (const auto& [name, write] : {std::pair<const char*, Write>{"a.off", write_off},
                                      {"a.obj", write_obj},
                                      {"a.stl", write_stl_text},
                                      {"b.stl", write_stl_binary},
                                      {"a.ply", write_ply}}) {
        std::stringstream whole;
        write(whole, body);
        for (std::size_t at = 0; at < whole.str().size(); at += 1 + whole.str().size() / 60)
            for (const bool cut : {true, false}) {
                std::string text = whole.str();
                if (cut)
                    text.resize(at);
                else
                    text[at] = '~';
                const File file(name, [&](std::ostream& out) { out << text; });
                try {
                    read_mesh(file.path());
                } catch (const Error&) {
                    ++refused;
                }
            }
    }
    EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace scree::scenarios
