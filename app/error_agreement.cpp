#include "app/error_agreement.hpp"

#include <mpi.h>

#include <chrono>
#include <functional>
#include <thread>

namespace scree::app {
namespace {

constexpr std::chrono::seconds kPatience{3};

}  // namespace

// A way of its own to the other ranks, which whatever they were doing when it went wrong cannot disturb.
struct ErrorAgreement::Channel {
    MPI_Comm comm = MPI_COMM_NULL;
    bool given_up = false;
};

ErrorAgreement::ErrorAgreement(const Communicator& ranks) : ranks_(ranks) {
    if (ranks.alone()) return;
    channel_ = std::make_unique<Channel>();
    MPI_Comm_dup(*static_cast<const MPI_Comm*>(ranks.handle()), &channel_->comm);
}

// MPI_Finalize frees the communicator: to free it here would be collective, and after an error not all ranks come here.
ErrorAgreement::~ErrorAgreement() = default;

bool ErrorAgreement::everywhere() {
    if (!channel_) return true;
    if (channel_->given_up) return false;
    MPI_Request arrived = MPI_REQUEST_NULL;
    MPI_Ibarrier(channel_->comm, &arrived);
    const auto until = std::chrono::steady_clock::now() + kPatience;
    int all = 0;
    for (;;) {
        MPI_Test(&arrived, &all, MPI_STATUS_IGNORE);
        if (all != 0 || std::chrono::steady_clock::now() > until) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    channel_->given_up = all == 0;
    return all != 0;
}

ErrorAgreement::Ending ErrorAgreement::agree(const std::string& message, int code) {
    Ending ending{code, true};
    if (!channel_) return ending;
    const std::uint64_t own = std::hash<std::string>{}(message);
    std::uint64_t first = own;
    MPI_Bcast(&first, 1, MPI_UINT64_T, 0, channel_->comm);
    MPI_Allreduce(MPI_IN_PLACE, &ending.code, 1, MPI_INT, MPI_MAX, channel_->comm);
    ending.shown = ranks_.root() || first != own;
    return ending;
}

}  // namespace scree::app
