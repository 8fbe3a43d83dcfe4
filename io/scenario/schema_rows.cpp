// How a row is written.
#include "io/scenario/schema_rows.hpp"

namespace scree::io::rows {

Row row(Kind kind, std::string path, Dimension dimension) {
    Row result;
    result.path = std::move(path);
    result.kind = kind;
    result.dimension = dimension;
    return result;
}
Row section(std::string path) {
    return row(Kind::section, std::move(path));
}
Row list(std::string path) {
    return row(Kind::list, std::move(path)).standardly("[]");
}
Row variant(std::string path) {
    return row(Kind::variant, std::move(path));
}
Row boolean(std::string path) {
    return row(Kind::boolean, std::move(path));
}
Row integer(std::string path) {
    return row(Kind::integer, std::move(path));
}
Row number(std::string path, Dimension dimension) {
    return row(Kind::number, std::move(path), dimension);
}
Row vector(std::string path, Dimension dimension) {
    return row(Kind::vector, std::move(path), dimension);
}
Row direction(std::string path) {
    return vector(std::move(path)).nonzero();
}
Row text(std::string path) {
    return row(Kind::text, std::move(path));
}
Row choice(std::string path, std::vector<std::string> choices, Kind kind) {
    Row result = row(kind, std::move(path));
    result.choices = std::move(choices);
    return result;
}
Row choices(std::string path, std::vector<std::string> names) {
    return choice(std::move(path), std::move(names), Kind::choices);
}
Row listing(Kind kind, std::string path, std::size_t length) {
    Row result = row(kind, std::move(path));
    result.length = length;
    return result;
}
Row numbers(std::string path, std::size_t length, Dimension dimension) {
    Row result = row(Kind::numbers, std::move(path), dimension);
    result.length = length;
    return result;
}
Row table(std::string path, std::vector<Column> columns) {
    Row result = row(Kind::table, std::move(path));
    result.columns = std::move(columns);
    return result;
}

}  // namespace scree::io::rows
