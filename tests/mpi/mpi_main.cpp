// main() of the tests of ranks: every rank runs every test; rank 0 reports, the others only their failures.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/parallel/communicator.hpp"

namespace {

class FailuresOnly : public testing::EmptyTestEventListener {
  public:
    explicit FailuresOnly(int rank) : rank_(rank) {}

  private:
    void OnTestPartResult(const testing::TestPartResult& result) override {
        if (!result.failed()) return;
        std::fprintf(stderr, "rank %d: %s:%d: %s\n", rank_, result.file_name() == nullptr ? "" : result.file_name(),
                     result.line_number(), result.message());
    }
    int rank_;
};

}  // namespace

int main(int argc, char** argv) {
    const scree::MpiSession session(&argc, &argv);
    testing::InitGoogleTest(&argc, argv);
    const scree::Communicator ranks = scree::Communicator::world();
    if (!ranks.root()) {
        testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
        delete listeners.Release(listeners.default_result_printer());
        listeners.Append(new FailuresOnly(ranks.rank()));
    }
    const int failed = RUN_ALL_TESTS();
    return ranks.any(failed != 0) ? 1 : 0;
}
