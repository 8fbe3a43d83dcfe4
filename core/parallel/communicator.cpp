#include "core/parallel/communicator.hpp"

#include <mpi.h>

#include <algorithm>
#include <cstdlib>

namespace scree {
namespace {

constexpr int kExchangeTag = 7;

MPI_Comm comm_of(const Communicator& ranks) {
    return *static_cast<const MPI_Comm*>(ranks.handle());
}

template <class T>
void reduce(const Communicator& ranks, std::span<T> values, MPI_Datatype type, MPI_Op op) {
    if (ranks.alone() || values.empty()) return;
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), type, op, comm_of(ranks));
}

}  // namespace

const Communicator& Communicator::self() {
    static const Communicator one;
    return one;
}

Communicator Communicator::world() {
    Communicator ranks;
    int started = 0;
    MPI_Initialized(&started);
    if (started == 0) return ranks;
    static MPI_Comm world = MPI_COMM_WORLD;
    MPI_Comm_rank(world, &ranks.rank_);
    MPI_Comm_size(world, &ranks.size_);
    ranks.handle_ = &world;
    return ranks;
}

void Communicator::max(std::span<double> values) const {
    reduce(*this, values, MPI_DOUBLE, MPI_MAX);
}
void Communicator::max(std::span<std::uint64_t> values) const {
    reduce(*this, values, MPI_UINT64_T, MPI_MAX);
}
void Communicator::sum(std::span<std::uint64_t> values) const {
    reduce(*this, values, MPI_UINT64_T, MPI_SUM);
}
void Communicator::sum(std::span<std::int64_t> values) const {
    reduce(*this, values, MPI_INT64_T, MPI_SUM);
}
void Communicator::sum(std::span<ExactSum> values) const {
    if (alone()) return;
    std::vector<std::int64_t> all;  // one message
    for (ExactSum& value : values) all.insert(all.end(), value.digits().begin(), value.digits().end());
    sum(std::span<std::int64_t>(all));
    auto from = all.begin();
    for (ExactSum& value : values) {
        const std::span<std::int64_t> digits = value.digits();
        std::copy_n(from, digits.size(), digits.begin());
        from += static_cast<std::ptrdiff_t>(digits.size());
    }
}
double Communicator::max(double value) const {
    max(std::span<double>(&value, 1));
    return value;
}
double Communicator::min(double value) const {
    return -max(-value);
}
double Communicator::sum(const ExactSum& value) const {
    if (alone()) return value.value();
    ExactSum whole = value;
    sum(whole.digits());
    return whole.value();
}
std::uint64_t Communicator::max(std::uint64_t value) const {
    max(std::span<std::uint64_t>(&value, 1));
    return value;
}
std::uint64_t Communicator::sum(std::uint64_t value) const {
    sum(std::span<std::uint64_t>(&value, 1));
    return value;
}
std::uint64_t Communicator::sum_before(std::uint64_t value) const {
    if (alone()) return 0;
    std::uint64_t before = 0;
    MPI_Exscan(&value, &before, 1, MPI_UINT64_T, MPI_SUM, comm_of(*this));
    return root() ? 0 : before;  // MPI leaves rank 0's result undefined
}
bool Communicator::any(bool value) const {
    return max(static_cast<std::uint64_t>(value ? 1 : 0)) != 0;
}

void Communicator::broadcast(std::string& text, int root) const {
    if (alone()) return;
    auto length = static_cast<std::uint64_t>(text.size());
    MPI_Bcast(&length, 1, MPI_UINT64_T, root, comm_of(*this));
    text.resize(length);
    constexpr std::uint64_t kPiece = std::uint64_t{1} << 30;  // counts are ints
    for (std::uint64_t at = 0; at < length; at += kPiece)
        MPI_Bcast(text.data() + at, static_cast<int>(std::min(kPiece, length - at)), MPI_BYTE, root, comm_of(*this));
}

std::vector<std::vector<double>> Communicator::gather(std::span<const double> values) const {
    if (alone()) return {std::vector<double>(values.begin(), values.end())};
    const int count = static_cast<int>(values.size());
    std::vector<double> all(root() ? values.size() * static_cast<std::size_t>(size_) : 0);
    MPI_Gather(values.data(), count, MPI_DOUBLE, all.data(), count, MPI_DOUBLE, 0, comm_of(*this));
    std::vector<std::vector<double>> result;
    if (root())
        for (auto row = all.begin(); row != all.end(); row += count) result.emplace_back(row, row + count);
    return result;
}

std::vector<std::byte> Communicator::all_gather(std::span<const std::byte> bytes) const {
    if (alone()) return {bytes.begin(), bytes.end()};
    std::vector<int> count(static_cast<std::size_t>(size_)), begin(count.size());
    const int own = static_cast<int>(bytes.size());
    MPI_Allgather(&own, 1, MPI_INT, count.data(), 1, MPI_INT, comm_of(*this));
    int total = 0;
    for (std::size_t r = 0; r < count.size(); ++r) {
        begin[r] = total;
        total += count[r];
    }
    std::vector<std::byte> all(static_cast<std::size_t>(total));
    MPI_Allgatherv(bytes.data(), own, MPI_BYTE, all.data(), count.data(), begin.data(), MPI_BYTE, comm_of(*this));
    return all;
}

// Nonblocking consensus (Hoefler, Siebert and Lumsdaine 2010): synchronous sends, and a barrier once they are taken.
std::vector<Communicator::Message> Communicator::exchange(const std::vector<Message>& outgoing) const {
    if (alone()) return outgoing;
    const MPI_Comm comm = comm_of(*this);
    std::vector<MPI_Request> sends(outgoing.size());
    for (std::size_t k = 0; k < outgoing.size(); ++k)
        MPI_Issend(outgoing[k].bytes.data(), static_cast<int>(outgoing[k].bytes.size()), MPI_BYTE, outgoing[k].rank,
                   kExchangeTag, comm, &sends[k]);
    std::vector<Message> incoming;
    MPI_Request done = MPI_REQUEST_NULL;
    bool waiting = false;
    for (int finished = 0; finished == 0;) {
        int there = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, kExchangeTag, comm, &there, &status);
        if (there != 0) {
            int bytes = 0;
            MPI_Get_count(&status, MPI_BYTE, &bytes);
            incoming.push_back({status.MPI_SOURCE, std::vector<std::byte>(static_cast<std::size_t>(bytes))});
            MPI_Recv(incoming.back().bytes.data(), bytes, MPI_BYTE, status.MPI_SOURCE, kExchangeTag, comm,
                     MPI_STATUS_IGNORE);
        }
        if (waiting) {
            MPI_Test(&done, &finished, MPI_STATUS_IGNORE);
        } else {
            int taken = 0;
            MPI_Testall(static_cast<int>(sends.size()), sends.data(), &taken, MPI_STATUSES_IGNORE);
            if (taken != 0) {
                MPI_Ibarrier(comm, &done);
                waiting = true;
            }
        }
    }
    MPI_Barrier(comm);  // or a fast rank's next exchange could be taken for this one
    std::sort(incoming.begin(), incoming.end(), [](const Message& a, const Message& b) { return a.rank < b.rank; });
    return incoming;
}

void Communicator::barrier() const {
    if (!alone()) MPI_Barrier(comm_of(*this));
}

void Communicator::abort(int exit_code) const {
    int started = 0;
    MPI_Initialized(&started);
    if (started != 0) MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
}

MpiSession::MpiSession(int* argc, char*** argv) {
    // A colour's velocities are some kilobytes: on one machine Open MPI hands over larger messages in two steps unless
    // told otherwise, which doubles the time of an exchange. What the user has set stands.
    setenv("OMPI_MCA_btl_vader_eager_limit", "32768", 0);
    // Open MPI, MPICH and Slurm's launcher each name the number of ranks in a variable of their own.
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "PMI_RANK"})
        if (std::getenv(name) != nullptr) {
            MPI_Init(argc, argv);
            return;
        }
}

MpiSession::~MpiSession() {
    int started = 0, ended = 0;
    MPI_Initialized(&started);
    MPI_Finalized(&ended);
    if (started != 0 && ended == 0) MPI_Finalize();
}

}  // namespace scree
