// How the work of a run is shared by its ranks, for the record {"kind": "ranks"} of run.jsonl.
#pragma once

#include <cstdint>
#include <string>

namespace scree::io {

struct RankLoads {
    struct Range {
        double min = 0.0, mean = 0.0, max = 0.0;  // over ranks
    };
    double time = 0.0;  // [s]
    std::uint64_t step = 0;
    int ranks = 1;
    std::uint64_t repartitions = 0;  // so far
    Range work, wait;                // [s] since the last record: time in steps less waiting, and the waiting
    Range bodies, ghosts, contacts;  // now
    Range messages, bytes;           // sent so far
};

std::string to_json(const RankLoads& loads);

}  // namespace scree::io
