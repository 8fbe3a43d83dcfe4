// Errors among ranks. What goes wrong on all ranks at the same point ends the run in order, with one message. What goes
// wrong on some of them leaves the others waiting for messages that never come: then all ranks are ended at once.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/errors.hpp"
#include "core/parallel/communicator.hpp"

namespace scree::app {

class ErrorAgreement {
  public:
    // Collective. `ranks` must outlive it.
    explicit ErrorAgreement(const Communicator& ranks);
    ~ErrorAgreement();
    ErrorAgreement(const ErrorAgreement&) = delete;
    ErrorAgreement& operator=(const ErrorAgreement&) = delete;

    // For a rank on which something was thrown: true if every rank asks this within a few seconds. Once it was false it
    // stays so: all that can be done then is Communicator::abort.
    bool everywhere();

    struct Ending {
        int code;    // the same on all ranks: the largest
        bool shown;  // this rank's message is to be shown: that of rank 0, and those of others if they differ from it
    };
    // Collective, after everywhere().
    Ending agree(const std::string& message, int code);

  private:
    struct Channel;
    const Communicator& ranks_;
    std::unique_ptr<Channel> channel_;  // none with one rank
};

// Work that rank 0 does for all, such as reading a scenario. The Error that it throws, every rank throws. `work` must
// not communicate. Collective.
template <class Work>
void at_root(const Communicator& ranks, Work&& work) {
    if (ranks.alone()) {
        work();
        return;
    }
    std::uint64_t code = 0;
    std::string message;
    if (ranks.root()) {
        try {
            work();
        } catch (const Error& error) {
            code = static_cast<std::uint64_t>(error.code());
            message = error.what();
        }
    }
    code = ranks.max(code);
    if (code == 0) return;
    ranks.broadcast(message);
    throw Error(static_cast<ExitCode>(code), message);
}

}  // namespace scree::app
