#include "io/results/wall_description.hpp"

#include <nlohmann/json.hpp>

#include "core/terrain.hpp"

namespace scree::io {

namespace {

using Json = nlohmann::ordered_json;

Json list(const Vec3& v) {
    return Json::array({v.x(), v.y(), v.z()});
}

struct Describe {
    std::string name;
    Json json;

    void operator()(const PlaneWall& w) { set("plane", {{"point", list(w.point)}, {"normal", list(w.normal)}}); }
    void operator()(const BoxWall& w) {
        set("box", {{"lower", list(w.lower)},
                    {"upper", list(w.upper)},
                    {"inside", w.inside},
                    {"open_top", w.open_top},
                    {"open_bottom", w.open_bottom}});
    }
    void operator()(const CylinderWall& w) {
        set("cylinder", {{"base", list(w.base)},
                         {"axis", list(w.axis)},
                         {"radius", w.radius},
                         {"length", w.length},
                         {"inside", w.inside}});
    }
    void operator()(const ConeWall& w) {
        set("cone", {{"base", list(w.base)},
                     {"axis", list(w.axis)},
                     {"radius_base", w.radius_base},
                     {"radius_end", w.radius_end},
                     {"length", w.length},
                     {"inside", w.inside}});
    }
    void operator()(const DiscWall& w) {
        set("disc", {{"centre", list(w.centre)}, {"normal", list(w.normal)}, {"radius", w.radius}});
    }
    void operator()(const OrificeFloor& w) {
        set("orifice_floor", {{"centre", list(w.centre)}, {"normal", list(w.normal)}, {"hole_radius", w.hole_radius}});
    }
    void operator()(const SlotFloor& w) {
        set("slot_floor", {{"centre", list(w.centre)},
                           {"normal", list(w.normal)},
                           {"along", list(w.along)},
                           {"width", w.width},
                           {"length", w.length}});
    }
    void operator()(const TerrainWall& w) {
        const Terrain& terrain = *w.terrain;
        set("terrain", {{"lower", list(terrain.lower)},
                        {"upper", list(terrain.upper)},
                        {"triangles", terrain.ground},
                        {"closed", terrain.border == TerrainBorder::closed}});
        if (!terrain.grid) return;
        const HeightGrid& grid = *terrain.grid;
        json.update({{"columns", grid.columns},
                     {"rows", grid.rows},
                     {"x", grid.x},
                     {"y", grid.y},
                     {"dx", grid.dx},
                     {"dy", grid.dy}});
    }

  private:
    void set(const char* shape, Json members) {
        name = shape;
        json = std::move(members);
    }
};

Describe describe(const WallShape& shape) {
    Describe description;
    std::visit(description, shape);
    return description;
}

}  // namespace

std::string shape_name(const WallShape& shape) {
    return describe(shape).name;
}
std::string shape_json(const WallShape& shape) {
    return describe(shape).json.dump();
}

}  // namespace scree::io
