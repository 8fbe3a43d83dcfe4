#include "io/results/rank_loads.hpp"

#include <nlohmann/json.hpp>

namespace scree::io {

std::string to_json(const RankLoads& loads) {
    using Json = nlohmann::ordered_json;
    const auto range = [](const RankLoads::Range& r) { return Json{{"min", r.min}, {"mean", r.mean}, {"max", r.max}}; };
    return Json{{"kind", "ranks"},
                {"time", loads.time},
                {"step", loads.step},
                {"ranks", loads.ranks},
                {"imbalance", loads.work.mean > 0.0 ? loads.work.max / loads.work.mean : 1.0},
                {"repartitions", loads.repartitions},
                {"work", range(loads.work)},
                {"wait", range(loads.wait)},
                {"bodies", range(loads.bodies)},
                {"ghosts", range(loads.ghosts)},
                {"contacts", range(loads.contacts)},
                {"messages", range(loads.messages)},
                {"bytes", range(loads.bytes)}}
        .dump();
}

}  // namespace scree::io
