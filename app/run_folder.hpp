// The folder of a run: what it is called, whether it may be written to, and that no two programs write to it at once.
// Only files that Scree itself makes are ever taken away.
#pragma once

#include <filesystem>
#include <string>

namespace scree::app {

class RunFolder {
  public:
    explicit RunFolder(std::filesystem::path path) : path_(std::move(path)) {}
    ~RunFolder();
    RunFolder(const RunFolder&) = delete;
    RunFolder& operator=(const RunFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path snapshots() const { return path_ / "snapshots"; }
    std::filesystem::path rasters() const { return path_ / "rasters"; }
    std::filesystem::path trajectories() const { return path_ / "trajectories.h5"; }
    std::filesystem::path checkpoints() const { return path_ / "checkpoint"; }
    std::filesystem::path history() const { return path_ / "history.h5"; }
    std::filesystem::path xdmf() const { return path_ / "run.xdmf"; }
    std::filesystem::path run_log() const { return path_ / "run.jsonl"; }
    std::filesystem::path summary() const { return path_ / "summary.yaml"; }
    std::filesystem::path stop_file() const { return path_ / "stop_now"; }

    bool exists() const;
    bool holds_a_run() const;
    // IoError if the folder holds a run that must not be replaced.
    void check_free(bool replace) const;
    // Makes the folder (and its parents) for a new run, and locks it; `replace`: the files of an earlier run go.
    void start(bool replace);
    // Locks the folder of a run that goes on.
    void resume();

  private:
    void lock();
    void check_writable() const;
    void clear() const;

    std::filesystem::path path_;
    int lock_ = -1;  // descriptor of the locked folder
};

// "out/silo" for "somewhere/silo.yaml"
std::filesystem::path default_run_folder(const std::filesystem::path& scenario);

}  // namespace scree::app
