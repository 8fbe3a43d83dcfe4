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

// The same messages again and again: their largest sizes are known to both sides, so each is bare numbers in a buffer
// that stays. send() returns at once; work done before receive() on the other side hides the transfer.
class RepeatedMessages {
  public:
    RepeatedMessages();
    ~RepeatedMessages();
    RepeatedMessages(RepeatedMessages&&) noexcept;
    RepeatedMessages& operator=(RepeatedMessages&&) noexcept;

    struct Message {
        int rank;           // to or from
        int tag;            // 0 to 99; another one for each message to a rank
        std::size_t bytes;  // at most
    };
    // Not collective. Outgoing and incoming messages have indices in the order given.
    void set_up(const Communicator& ranks, std::span<const Message> outgoing, std::span<const Message> incoming);
    // To be filled before send(); waits until what was in it is gone.
    std::byte* outgoing(std::size_t k);
    void send(std::size_t k, std::size_t bytes);
    // Waits for the message.
    const std::byte* receive(std::size_t k, std::size_t bytes);
    // Until all sends are taken: before set_up() or the end.
    void finish();
    Traffic& traffic();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace scree
