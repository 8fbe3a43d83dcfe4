// Collects the faults of a scenario, so that a user sees all of them at once, each as
//   file:line:col: error: what is wrong, what was expected (did you mean 'x'?)
//       the source line
//       ^
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/scenario/scenario_node.hpp"

namespace scree::io {

class Diagnostics {
  public:
    // The text of a file that marks may point into; kept for the source lines.
    void add_source(const std::string& file, const std::string& text);
    void error(const Mark& mark, const std::string& message);
    void warning(const Mark& mark, const std::string& message);

    bool has_errors() const { return !errors_.empty(); }
    std::size_t error_count() const { return errors_.size(); }
    // All errors in order of file and line, with source line and caret; "" if none.
    std::string report() const;
    std::string warnings() const;
    // Throws ScenarioError(report()) if there is any error.
    void throw_if_errors() const;

  private:
    struct Entry {
        Mark mark;
        std::string message;
    };
    struct Source {
        std::string file;
        std::vector<std::string> lines;
    };
    std::string render(const std::vector<Entry>& entries, std::string_view severity) const;

    std::vector<Source> sources_;
    std::vector<Entry> errors_, warnings_;
};

// The candidate nearest to `word` by edit distance, "" if none is near enough to be meant.
std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace scree::io
