// Work with files that can fail on one rank: all ranks learn of it at the same point and throw the same IoError, so
// that none waits for one that is gone.
#pragma once

#include <string>

#include "core/errors.hpp"
#include "core/parallel/communicator.hpp"

namespace scree {

// Collective. If `fault` is not empty on any rank, every rank throws IoError with the text of the first such rank.
void agree_on_fault(const std::string& fault, const Communicator& ranks);

// What went wrong in `work`; empty if nothing did.
template <class Work>
std::string fault_of(Work&& work) {
    try {
        work();
    } catch (const IoError& error) {
        return error.what();
    }
    return {};
}

// Collective. `work` must not communicate.
template <class Work>
void together(const Communicator& ranks, Work&& work) {
    if (ranks.alone()) {
        work();
    } else {
        agree_on_fault(fault_of(work), ranks);
    }
}
template <class Work>
void by_root(const Communicator& ranks, Work&& work) {
    together(ranks, [&] {
        if (ranks.root()) work();
    });
}

}  // namespace scree
