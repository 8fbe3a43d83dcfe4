#include "core/parallel/neighbour_messages.hpp"

#include <mpi.h>

#include <chrono>

namespace scree {
namespace {

constexpr int kSwapTag = 8;
constexpr int kRepeatedTag = 16;  // and those after it

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

struct RepeatedMessages::Impl {
    struct Buffer {
        int rank = 0, tag = 0;
        std::vector<std::byte> bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    MPI_Comm comm = MPI_COMM_NULL;
    std::vector<Buffer> out, in;  // keep what they have allocated
    std::size_t out_count = 0;
    Traffic traffic;

    static void lay_out(std::vector<Buffer>& buffers, std::span<const Message> messages) {
        if (buffers.size() < messages.size()) buffers.resize(messages.size());
        for (std::size_t k = 0; k < messages.size(); ++k) {
            buffers[k].rank = messages[k].rank;
            buffers[k].tag = kRepeatedTag + messages[k].tag;
            buffers[k].bytes.resize(messages[k].bytes);
        }
    }
};

RepeatedMessages::RepeatedMessages() : impl_(std::make_unique<Impl>()) {}
RepeatedMessages::~RepeatedMessages() = default;
RepeatedMessages::RepeatedMessages(RepeatedMessages&&) noexcept = default;
RepeatedMessages& RepeatedMessages::operator=(RepeatedMessages&&) noexcept = default;

void RepeatedMessages::set_up(const Communicator& ranks, std::span<const Message> outgoing,
                              std::span<const Message> incoming) {
    finish();
    if (ranks.handle() != nullptr) impl_->comm = *static_cast<const MPI_Comm*>(ranks.handle());
    Impl::lay_out(impl_->out, outgoing);
    Impl::lay_out(impl_->in, incoming);
    impl_->out_count = outgoing.size();
}

std::byte* RepeatedMessages::outgoing(std::size_t k) {
    Impl::Buffer& buffer = impl_->out[k];
    if (buffer.request != MPI_REQUEST_NULL) MPI_Wait(&buffer.request, MPI_STATUS_IGNORE);
    return buffer.bytes.data();
}

void RepeatedMessages::send(std::size_t k, std::size_t bytes) {
    Impl::Buffer& buffer = impl_->out[k];
    MPI_Isend(buffer.bytes.data(), as_int(bytes), MPI_BYTE, buffer.rank, buffer.tag, impl_->comm, &buffer.request);
    ++impl_->traffic.messages;
    impl_->traffic.bytes += bytes;
}

const std::byte* RepeatedMessages::receive(std::size_t k, std::size_t bytes) {
    Impl::Buffer& buffer = impl_->in[k];
    const auto begin = Clock::now();
    MPI_Recv(buffer.bytes.data(), as_int(bytes), MPI_BYTE, buffer.rank, buffer.tag, impl_->comm, MPI_STATUS_IGNORE);
    impl_->traffic.wait_seconds += since(begin);
    return buffer.bytes.data();
}

void RepeatedMessages::finish() {
    for (std::size_t k = 0; k < impl_->out_count; ++k) outgoing(k);
}

Traffic& RepeatedMessages::traffic() {
    return impl_->traffic;
}

}  // namespace scree
