// Checkpoints: the whole state (core/state.hpp), bit for bit, from which a run continues to the same bits.
// `checkpoint/step_NNNNNNNNNN.h5`, the last two are kept. A seal over all bytes of the file
// (io/results/sealed_file.hpp) and a 64-bit checksum over every number of the state are verified when it is read.
//
// On many ranks all functions but list_checkpoints are collective, and throw on all ranks or on none. The file is the
// same whoever wrote it (the bodies in order of id, the impulses in order of key), and any number of ranks can read it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/state.hpp"
#include "io/results/provenance.hpp"

namespace scree::io {

// Writes <folder>/step_<state.step>.h5 and then removes all but the two newest. Flush the history before, so that
// every row up to the checkpoint is in its file. Ghosts are left out. Returns the path.
std::string write_checkpoint(const std::string& folder, const State& state, const Provenance& provenance,
                             const Communicator& ranks = Communicator::self());

// Each rank gets an equal slice of the bodies by id, the impulses of contacts whose body a it has, and all the rest.
// Throws IoError, which names the file, if it cannot be read, is not a checkpoint, or its checksum is wrong.
State read_checkpoint(const std::string& path, Provenance* provenance = nullptr,
                      const Communicator& ranks = Communicator::self());

struct FoundCheckpoint {
    std::string path;
    State state;
    Provenance provenance;
    std::vector<std::string> messages;  // why newer files were passed over
};
// The newest readable checkpoint; nothing if the folder has none or is not there. Throws IoError if there are some and
// none can be read. Rank 0 says which files there are; one that any rank cannot read is passed over by all.
std::optional<FoundCheckpoint> find_latest_checkpoint(const std::string& folder,
                                                      const Communicator& ranks = Communicator::self());

// Checkpoints of a folder, newest first.
std::vector<std::string> list_checkpoints(const std::string& folder);

}  // namespace scree::io
