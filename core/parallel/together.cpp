#include "core/parallel/together.hpp"

namespace scree {

void agree_on_fault(const std::string& fault, const Communicator& ranks) {
    const std::uint64_t after = static_cast<std::uint64_t>(ranks.size() - ranks.rank());
    const std::uint64_t first = ranks.max(fault.empty() ? std::uint64_t{0} : after);
    if (first == 0) return;
    const int rank = ranks.size() - static_cast<int>(first);
    std::string text = fault;
    ranks.broadcast(text, rank);
    if (!ranks.alone()) text += " (on rank " + std::to_string(rank) + ")";
    throw IoError(text);
}

}  // namespace scree
