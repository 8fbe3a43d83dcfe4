// One value of a scenario: from YAML to what its row in the schema table says.
#pragma once

#include <string>

#include "io/scenario/schema.hpp"
#include "io/scenario/yaml_tree.hpp"

namespace scree::io {

class ValueReader {
  public:
    explicit ValueReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    // Fills `node.value`; false if the value is not what the schema expects (the faults are then in the diagnostics).
    bool read(const SchemaNode& schema, const YamlValue& yaml, const std::string& path, Node& node);
    // "path: problem; expected ..."
    void refuse(const Mark& mark, const std::string& path, const std::string& problem, const std::string& expected);
    // A name of an item may become the name of a column or of a dataset: letters, digits, '_' and '-'.
    bool check_name(const std::string& name, const Mark& mark, const std::string& path);

  private:
    bool read_boolean(const SchemaNode& schema, const YamlValue& yaml, const std::string& path, bool& value);
    bool read_integer(const Row& row, const YamlValue& yaml, const std::string& path, std::int64_t& value);
    bool read_number(Dimension dimension, const Range& range, const YamlValue& yaml, const std::string& path,
                     double& value);
    bool read_vector(const SchemaNode& schema, const YamlValue& yaml, const std::string& path, Vec3& value);
    bool read_text(const SchemaNode& schema, const YamlValue& yaml, const std::string& path, std::string& value);
    bool read_list(const SchemaNode& schema, const YamlValue& yaml, const std::string& path, Node& node);
    bool read_table(const SchemaNode& schema, const YamlValue& yaml, const std::string& path, Node& node);
    bool read_row(const Row& row, const YamlValue& yaml, Node& node);

    Diagnostics& diagnostics_;
};

// What a value is, for messages: "the text 'abc'", "a list", "no value".
std::string describe(const YamlValue& yaml);

}  // namespace scree::io
