#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "scenarios/shapes/mesh_formats.hpp"

namespace scree::scenarios {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

}  // namespace

void MeshText::skip_blanks(bool lines) {
    const std::string& text = file_.bytes;
    while (at_ < text.size()) {
        if (!comment_.empty() && text.compare(at_, comment_.size(), comment_) == 0)
            at_ = std::min(text.find('\n', at_), text.size());
        else if (is_blank(text[at_]) && (lines || text[at_] != '\n'))
            ++at_;
        else
            return;
    }
}

std::string_view MeshText::word_of_line() {
    skip_blanks(false);
    const std::size_t begin = at_;
    while (at_ < file_.bytes.size() && !is_blank(file_.bytes[at_])) ++at_;
    return std::string_view(file_.bytes).substr(begin, at_ - begin);
}

std::string_view MeshText::word() {
    skip_blanks(true);
    if (at_ == file_.bytes.size()) fail("the file ends too early");
    return word_of_line();
}

void MeshText::next_line() {
    const std::size_t end = file_.bytes.find('\n', at_);
    at_ = end == std::string::npos ? file_.bytes.size() : end + 1;
}

bool MeshText::at_end() {
    skip_blanks(true);
    return at_ == file_.bytes.size();
}

void MeshText::fail(const std::string& what) const {
    const auto line = 1 + std::count(file_.bytes.begin(), file_.bytes.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw IoError(fmt::format("{}:{}: {}", file_.path, line, what));
}

double MeshText::as_number(std::string_view word, std::string_view what) const {
    double x = 0.0;
    const std::string_view digits = word.substr(!word.empty() && word[0] == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
    if (error != std::errc() || end != digits.data() + digits.size() || digits.empty())
        fail(fmt::format("'{:.40}' where {} is expected, a number", word, what));
    return x;
}

std::int64_t MeshText::as_whole(std::string_view word, std::string_view what) const {
    std::int64_t n = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n);
    if (error != std::errc() || end != word.data() + word.size() || word.empty())
        fail(fmt::format("'{:.40}' where {} is expected, a whole number", word, what));
    return n;
}

std::uint32_t MeshText::as_index(std::int64_t index, std::size_t vertices) const {
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
        fail(fmt::format("a face names vertex {}, counted from 0; there are {}", index, vertices));
    return static_cast<std::uint32_t>(index);
}

double MeshText::number(std::string_view what) {
    const std::string_view next = word();
    return as_number(next, what);
}
std::int64_t MeshText::whole(std::string_view what) {
    const std::string_view next = word();
    return as_whole(next, what);
}
std::uint32_t MeshText::index(std::size_t vertices) {
    const std::int64_t n = whole("a vertex of a face");
    return as_index(n, vertices);
}

}  // namespace scree::scenarios
