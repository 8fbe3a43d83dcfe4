#include "core/parallel/neighbour_messages.hpp"

#include <mpi.h>

#include <chrono>

namespace scree {
namespace {

constexpr int kSwapTag = 8;
constexpr int kPhaseTag = 16;  // and those after it, one a phase

using Clock = std::chrono::steady_clock;
double since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}
int as_int(std::size_t n) {
    return static_cast<int>(n);
}

}  // namespace

std::vector<std::vector<std::byte>> swap(const Communicator& ranks, std::span<const int> neighbours,
                                         const std::vector<std::vector<std::byte>>& outgoing, Traffic& traffic) {
    std::vector<std::vector<std::byte>> incoming(neighbours.size());
    if (neighbours.empty()) return incoming;
    const MPI_Comm comm = *static_cast<const MPI_Comm*>(ranks.handle());
    std::vector<MPI_Request> sends(neighbours.size());
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
        MPI_Isend(outgoing[k].data(), as_int(outgoing[k].size()), MPI_BYTE, neighbours[k], kSwapTag, comm, &sends[k]);
        ++traffic.messages;
        traffic.bytes += outgoing[k].size();
    }
    const auto begin = Clock::now();
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
        MPI_Status status;
        int bytes = 0;
        MPI_Probe(neighbours[k], kSwapTag, comm, &status);
        MPI_Get_count(&status, MPI_BYTE, &bytes);
        incoming[k].resize(static_cast<std::size_t>(bytes));
        MPI_Recv(incoming[k].data(), bytes, MPI_BYTE, neighbours[k], kSwapTag, comm, MPI_STATUS_IGNORE);
    }
    MPI_Waitall(as_int(sends.size()), sends.data(), MPI_STATUSES_IGNORE);
    traffic.wait_seconds += since(begin);
    return incoming;
}

struct PhasedExchange::Impl {
    struct Message {
        int rank;
        std::size_t neighbour;
        std::vector<std::byte> bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    struct Phase {
        std::vector<Message> out, in;  // those that are not empty
    };
    MPI_Comm comm = MPI_COMM_NULL;
    std::vector<Phase> phase;
    Traffic traffic;

    static Message* find(std::vector<Message>& messages, std::size_t neighbour) {
        for (Message& m : messages)
            if (m.neighbour == neighbour) return &m;
        return nullptr;
    }
};

PhasedExchange::PhasedExchange() : impl_(std::make_unique<Impl>()) {}
PhasedExchange::~PhasedExchange() = default;
PhasedExchange::PhasedExchange(PhasedExchange&&) noexcept = default;
PhasedExchange& PhasedExchange::operator=(PhasedExchange&&) noexcept = default;

void PhasedExchange::set_up(const Communicator& ranks, std::span<const int> neighbours,
                            const std::vector<std::vector<std::size_t>>& outgoing,
                            const std::vector<std::vector<std::size_t>>& incoming) {
    finish();
    if (!neighbours.empty()) impl_->comm = *static_cast<const MPI_Comm*>(ranks.handle());
    impl_->phase.resize(outgoing.size());
    const auto make = [&](std::vector<Impl::Message>& messages, const std::vector<std::size_t>& sizes) {
        std::size_t used = 0;
        for (std::size_t k = 0; k < neighbours.size(); ++k) {
            if (sizes[k] == 0) continue;
            if (used == messages.size()) messages.emplace_back();
            Impl::Message& m = messages[used++];  // keeps what it has allocated
            m.rank = neighbours[k];
            m.neighbour = k;
            m.bytes.resize(sizes[k]);
        }
        messages.resize(used);
    };
    for (std::size_t f = 0; f < outgoing.size(); ++f) {
        make(impl_->phase[f].out, outgoing[f]);
        make(impl_->phase[f].in, incoming[f]);
    }
}

std::span<std::byte> PhasedExchange::outgoing(std::size_t phase, std::size_t neighbour) {
    Impl::Message* m = Impl::find(impl_->phase[phase].out, neighbour);
    if (m == nullptr) return {};
    MPI_Wait(&m->request, MPI_STATUS_IGNORE);
    return m->bytes;
}

std::span<const std::byte> PhasedExchange::incoming(std::size_t phase, std::size_t neighbour) const {
    const Impl::Message* m = Impl::find(impl_->phase[phase].in, neighbour);
    if (m == nullptr) return {};
    return m->bytes;
}

void PhasedExchange::send(std::size_t phase) {
    for (Impl::Message& m : impl_->phase[phase].out) {
        MPI_Isend(m.bytes.data(), as_int(m.bytes.size()), MPI_BYTE, m.rank, kPhaseTag + as_int(phase), impl_->comm,
                  &m.request);
        ++impl_->traffic.messages;
        impl_->traffic.bytes += m.bytes.size();
    }
}

void PhasedExchange::receive(std::size_t phase) {
    if (impl_->phase[phase].in.empty()) return;
    const auto begin = Clock::now();
    for (Impl::Message& m : impl_->phase[phase].in)
        MPI_Recv(m.bytes.data(), as_int(m.bytes.size()), MPI_BYTE, m.rank, kPhaseTag + as_int(phase), impl_->comm,
                 MPI_STATUS_IGNORE);
    impl_->traffic.wait_seconds += since(begin);
}

void PhasedExchange::finish() {
    for (Impl::Phase& phase : impl_->phase)
        for (Impl::Message& m : phase.out) MPI_Wait(&m.request, MPI_STATUS_IGNORE);
}

Traffic& PhasedExchange::traffic() {
    return impl_->traffic;
}

}  // namespace scree
