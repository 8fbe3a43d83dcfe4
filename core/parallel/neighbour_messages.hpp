// Messages between ranks that know each other: one to each neighbour and one from each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/parallel/communicator.hpp"

namespace scree {

// What a rank sent so far, and how long it waited.
struct Traffic {
    std::uint64_t messages = 0, bytes = 0;
    double wait_seconds = 0.0;
};

// One message of any size to each neighbour, one from each, in the order of `neighbours`.
std::vector<std::vector<std::byte>> swap(const Communicator& ranks, std::span<const int> neighbours,
                                         const std::vector<std::vector<std::byte>>& outgoing, Traffic& traffic);

// The same messages again and again, in phases: their sizes are known to both sides. send() returns at once; work done
// before receive() of the same phase hides the transfer.
class PhasedExchange {
  public:
    PhasedExchange();
    ~PhasedExchange();
    PhasedExchange(PhasedExchange&&) noexcept;
    PhasedExchange& operator=(PhasedExchange&&) noexcept;

    // Bytes of each message, [phase][neighbour]; 0: none. Not collective.
    void set_up(const Communicator& ranks, std::span<const int> neighbours,
                const std::vector<std::vector<std::size_t>>& outgoing,
                const std::vector<std::vector<std::size_t>>& incoming);
    // To be filled before send(); waits until the last message from it is gone.
    std::span<std::byte> outgoing(std::size_t phase, std::size_t neighbour);
    void send(std::size_t phase);
    void receive(std::size_t phase);
    std::span<const std::byte> incoming(std::size_t phase, std::size_t neighbour) const;
    // Until all sends are taken: before set_up() or the end.
    void finish();
    Traffic& traffic();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace scree
