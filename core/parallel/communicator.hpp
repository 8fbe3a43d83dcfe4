// The ranks of a run, and what they tell each other. A communicator of one rank needs no MPI: every reduction returns
// what it was given. All functions but rank(), size() and abort() are collective: every rank calls them in one order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/exact_sum.hpp"

namespace scree {

class Communicator {
  public:
    // One rank, alone.
    Communicator() = default;
    static const Communicator& self();
    // The ranks that mpirun started; alone() if it did not. Needs an MpiSession.
    static Communicator world();

    int rank() const { return rank_; }
    int size() const { return size_; }
    bool alone() const { return size_ == 1; }
    bool root() const { return rank_ == 0; }

    // In place, element by element, over all ranks. Maxima, minima, and sums of integers do not depend on an order.
    void max(std::span<double> values) const;
    void max(std::span<std::uint64_t> values) const;
    void sum(std::span<std::uint64_t> values) const;  // wraps around
    void sum(std::span<std::int64_t> values) const;
    void sum(std::span<ExactSum> values) const;
    double max(double value) const;
    double min(double value) const;
    double sum(const ExactSum& value) const;  // rounded once
    std::uint64_t max(std::uint64_t value) const;
    std::uint64_t sum(std::uint64_t value) const;
    // The sum over the ranks before this one.
    std::uint64_t sum_before(std::uint64_t value) const;
    bool any(bool value) const;
    bool all(bool value) const { return !any(!value); }

    // The text of rank `root` on every rank.
    void broadcast(std::string& text, int root = 0) const;
    // The numbers of each rank, on rank 0 only (for reports; a few numbers a rank).
    std::vector<std::vector<double>> gather(std::span<const double> values) const;

    // The bytes of all ranks, one rank after the other, on every rank: for what is few.
    std::vector<std::byte> all_gather(std::span<const std::byte> bytes) const;

    // Messages to a few ranks, when the receivers do not know who writes. Sorted by the sender's rank. A message to
    // oneself arrives too. At most one message a receiver.
    struct Message {
        int rank;  // receiver; after the exchange: sender
        std::vector<std::byte> bytes;
    };
    std::vector<Message> exchange(const std::vector<Message>& outgoing) const;

    void barrier() const;
    // Ends all ranks at once with this exit code. Does not return.
    [[noreturn]] void abort(int exit_code) const;

    // MPI_Comm, for those who include mpi.h (never in a header): *static_cast<const MPI_Comm*>(ranks.handle()).
    // Null if alone.
    const void* handle() const { return handle_; }

  private:
    int rank_ = 0, size_ = 1;
    const void* handle_ = nullptr;
};

// MPI from first to last: one object in main(). Without mpirun nothing is started.
class MpiSession {
  public:
    MpiSession(int* argc, char*** argv);
    ~MpiSession();
    MpiSession(const MpiSession&) = delete;
    MpiSession& operator=(const MpiSession&) = delete;
};

// Values of trivially copyable types to and from the bytes of a message.
class Packer {
  public:
    template <class T>
    void put(const T& value) {
        put_all(std::span<const T>(&value, 1));
    }
    template <class T>
    void put_all(std::span<const T> values) {
        const std::size_t before = bytes.size();
        bytes.resize(before + values.size_bytes());
        if (!values.empty()) __builtin_memcpy(bytes.data() + before, values.data(), values.size_bytes());
    }
    std::vector<std::byte> bytes;
};
// Messages being filled, one a receiving rank.
class Outbox {
  public:
    Packer& operator[](int rank) { return packer_[rank]; }
    // In order of rank; the box is empty after it.
    std::vector<Communicator::Message> take() {
        std::vector<Communicator::Message> messages;
        messages.reserve(packer_.size());
        for (auto& [rank, packer] : packer_) messages.push_back({rank, std::move(packer.bytes)});
        packer_.clear();
        return messages;
    }

  private:
    std::map<int, Packer> packer_;
};
class Unpacker {
  public:
    explicit Unpacker(std::span<const std::byte> bytes) : left_(bytes) {}
    bool empty() const { return left_.empty(); }
    template <class T>
    T get() {
        T value;
        __builtin_memcpy(&value, left_.data(), sizeof(T));
        left_ = left_.subspan(sizeof(T));
        return value;
    }

  private:
    std::span<const std::byte> left_;
};

}  // namespace scree
