#include "io/scenario/yaml_tree.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "io/scenario/utf8.hpp"

namespace scree::io {
namespace {

// Aliases of aliases can describe a tree of any size in a few lines; no scenario is as large as this.
constexpr std::size_t kMostValues = 4'000'000;

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
        lines.push_back(text.substr(0, end));
        text.remove_prefix(end + 1);
    }
    lines.push_back(text);
    return lines;
}

std::size_t count_values(const YamlValue& value) {
    std::size_t count = 1;
    for (const YamlValue& item : value.items) count += count_values(item);
    for (const YamlEntry& entry : value.entries) count += count_values(entry.value);
    return count;
}

struct Fault {
    Mark mark;
    std::string message;
};

class TreeBuilder : public YAML::EventHandler {
  public:
    TreeBuilder(const std::string& text, const std::string& file, Diagnostics& diagnostics)
        : text_(text), lines_(lines_of(text)), file_(file), diagnostics_(diagnostics) {}

    YamlValue root;

    Mark place(const YAML::Mark& mark) const {
        Mark result{file_, mark.line + 1, mark.column + 1};
        if (mark.line < 0 || static_cast<std::size_t>(mark.line) >= lines_.size()) return result;
        // yaml-cpp counts bytes, people count characters.
        const std::string_view line = lines_[static_cast<std::size_t>(mark.line)];
        const auto end = std::min(line.size(), static_cast<std::size_t>(std::max(mark.column, 0)));
        const auto inner = std::count_if(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(end),
                                         [](char c) { return !begins_character(c); });
        result.column -= static_cast<int>(inner);
        return result;
    }
    // The innermost [ or { that is still open.
    const Mark* open_bracket() const {
        const auto open = std::find_if(frames_.rbegin(), frames_.rend(), [](const Frame& f) { return f.flow; });
        return open == frames_.rend() ? nullptr : &open->value.mark;
    }

    void OnDocumentStart(const YAML::Mark&) override {}
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { complete(begin(mark), anchor); }
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        const auto found = anchors_.find(anchor);
        if (found == anchors_.end()) throw Fault{place(mark), "this alias stands inside the value that it refers to"};
        values_ += count_values(found->second);
        if (values_ > kMostValues) throw Fault{place(mark), "aliases make this file too large"};
        complete(found->second, 0);
    }
    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  const std::string& text) override {
        YamlValue value = begin(mark);
        value.kind = YamlValue::Kind::scalar;
        value.text = text;
        value.quoted = tag != "?";
        if (tag == "!") check_closed(mark, value.mark);
        if (tag != "?" && tag != "!" && tag != "tag:yaml.org,2002:str") refuse_tag(mark, tag);
        complete(std::move(value), anchor);
    }
    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                         YAML::EmitterStyle::value style) override {
        open(mark, tag, anchor, style, YamlValue::Kind::list);
    }
    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                    YAML::EmitterStyle::value style) override {
        open(mark, tag, anchor, style, YamlValue::Kind::map);
    }
    void OnSequenceEnd() override { close(); }
    void OnMapEnd() override { close(); }

  private:
    struct Frame {
        YamlValue value;
        YAML::anchor_t anchor = 0;
        bool flow = false;
        bool has_key = false;  // a map: the key is there, its value not yet
        bool drop = false;     // a map: the value belongs to a key that was refused
        std::string key{};
        Mark key_mark{};
        std::vector<YamlValue> merged{};  // values of `<<`
    };

    YamlValue begin(const YAML::Mark& mark) const {
        YamlValue value;
        value.mark = place(mark);
        return value;
    }
    // yaml-cpp takes the end of the file for a closing quote.
    void check_closed(const YAML::Mark& mark, const Mark& opened) const {
        const std::string_view line = lines_.at(static_cast<std::size_t>(mark.line));
        auto i = static_cast<std::size_t>(line.data() - text_.data()) + static_cast<std::size_t>(mark.column);
        while (i < text_.size() && (text_[i] == '&' || text_[i] == '!')) {  // an anchor, a tag
            i = text_.find_first_not_of(" \t\r\n", std::min(text_.find_first_of(" \t\r\n", i), text_.size()));
        }
        if (i >= text_.size() || (text_[i] != '"' && text_[i] != '\'')) return;
        const char quote = text_[i];
        for (++i; i < text_.size(); ++i) {
            if (quote == '"' && text_[i] == '\\') {
                ++i;
            } else if (text_[i] == quote) {
                return;
            }
        }
        throw Fault{opened, "this quote is not closed"};
    }
    void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
        diagnostics_.error(place(mark), fmt::format("the tag '{}' has no meaning here", tag));
    }
    void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, YAML::EmitterStyle::value style,
              YamlValue::Kind kind) {
        if (tag != "?" && tag != "!") refuse_tag(mark, tag);
        Frame frame{begin(mark), anchor, style == YAML::EmitterStyle::Flow};
        frame.value.kind = kind;
        frames_.push_back(std::move(frame));
    }
    void close() {
        Frame frame = std::move(frames_.back());
        frames_.pop_back();
        for (YamlValue& merged : frame.merged) merge_below(frame.value, merged);
        complete(std::move(frame.value), frame.anchor);
    }

    void merge_below(YamlValue& map, YamlValue& merged) {
        if (merged.kind == YamlValue::Kind::list) {
            for (YamlValue& item : merged.items) merge_below(map, item);
        } else if (merged.kind == YamlValue::Kind::map) {
            for (YamlEntry& entry : merged.entries) {
                if (map.find(entry.key) == nullptr) map.entries.push_back(std::move(entry));
            }
        } else {
            diagnostics_.error(merged.mark, "'<<' takes a map, or a list of maps");
        }
    }

    // A value is complete: it is the document, an item of a list, a key, or the value of a key.
    void complete(YamlValue value, YAML::anchor_t anchor) {
        if (++values_ > kMostValues) throw Fault{value.mark, "this file is too large for a scenario"};
        if (anchor != 0) anchors_[anchor] = value;
        if (frames_.empty()) {
            root = std::move(value);
            return;
        }
        Frame& frame = frames_.back();
        if (frame.value.kind == YamlValue::Kind::list) {
            frame.value.items.push_back(std::move(value));
        } else if (!frame.has_key) {
            take_key(frame, value);
        } else {
            take_value(frame, std::move(value));
        }
    }

    void take_key(Frame& frame, const YamlValue& key) {
        frame.has_key = true;
        frame.drop = false;
        frame.key = key.text;
        frame.key_mark = key.mark;
        if (key.kind != YamlValue::Kind::scalar) {
            diagnostics_.error(key.mark, "a key must be a name");
            frame.drop = true;
        } else if (const YamlEntry* first = frame.value.find(key.text)) {
            diagnostics_.error(key.mark,
                               fmt::format("'{}' is given twice; the first is on line {}", key.text, first->mark.line));
            frame.drop = true;
        }
    }

    void take_value(Frame& frame, YamlValue value) {
        frame.has_key = false;
        // yaml-cpp puts a value that is not there at whatever comes next.
        if (value.kind == YamlValue::Kind::null) value.mark = frame.key_mark;
        if (frame.drop) return;
        if (frame.key == "<<") {
            frame.merged.push_back(std::move(value));
        } else {
            frame.value.entries.push_back({frame.key, frame.key_mark, std::move(value)});
        }
    }

    std::string_view text_;
    std::vector<std::string_view> lines_;
    std::string file_;
    Diagnostics& diagnostics_;
    std::vector<Frame> frames_;
    std::map<YAML::anchor_t, YamlValue> anchors_;
    std::size_t values_ = 0;
};

// What yaml-cpp says, in words that help.
std::string plain_words(const std::string& message) {
    static const std::map<std::string, std::string, std::less<>> words{
        {"illegal map value",
         "a ':' that cannot stand here: keys of one map begin in one column, and a text with ': ' needs quotes"},
        {"end of map not found", "this line fits no map above it: keys of one map begin in one column"},
        {"end of sequence not found", "this line fits no list above it: the '-' of one list stand in one column"},
        {"illegal block entry", "a '-' that cannot stand here: a list begins on a line of its own"},
        {"bad file", "the file is nested too deeply"},
        {"unknown token", "a text that begins with this character needs quotes"},
    };
    const auto found = words.find(message);
    return found == words.end() ? message : found->second;
}

Fault explain_fault(const YAML::Exception& exception, const TreeBuilder& builder) {
    const Mark* open = builder.open_bracket();
    if (open != nullptr && exception.msg == "end of sequence flow not found") return {*open, "this '[' is not closed"};
    if (open != nullptr && exception.msg == "end of map flow not found") return {*open, "this '{' is not closed"};
    return {builder.place(exception.mark), "YAML: " + plain_words(exception.msg)};
}

}  // namespace

YamlEntry* YamlValue::find(std::string_view key) {
    const auto found = std::find_if(entries.begin(), entries.end(), [&](const YamlEntry& e) { return e.key == key; });
    return found == entries.end() ? nullptr : &*found;
}
const YamlEntry* YamlValue::find(std::string_view key) const {
    return const_cast<YamlValue*>(this)->find(key);
}

std::optional<YamlValue> parse_yaml(const std::string& given, const std::string& file, Diagnostics& diagnostics) {
    const std::string text = given + "\n";  // at an end without a new line yaml-cpp misplaces its faults
    TreeBuilder builder(text, file, diagnostics);
    try {
        std::istringstream stream(text);
        YAML::Parser parser(stream);
        if (!parser.HandleNextDocument(builder)) return YamlValue{{}, {}, false, {}, {}, {file, 1, 1}};
        YamlValue first = std::move(builder.root);
        TreeBuilder rest(text, file, diagnostics);
        if (parser.HandleNextDocument(rest)) {
            diagnostics.error(rest.root.mark, "a second document begins before here; a scenario is one document");
            return std::nullopt;
        }
        return first;
    } catch (const Fault& fault) {
        diagnostics.error(fault.mark, fault.message);
    } catch (const YAML::Exception& exception) {
        const Fault fault = explain_fault(exception, builder);
        diagnostics.error(fault.mark, fault.message);
    }
    return std::nullopt;
}

void merge_over(YamlValue& base, YamlValue over) {
    if (base.kind != YamlValue::Kind::map || over.kind != YamlValue::Kind::map) {
        base = std::move(over);
        return;
    }
    for (YamlEntry& entry : over.entries) {
        if (YamlEntry* old = base.find(entry.key)) {
            old->mark = entry.mark;
            merge_over(old->value, std::move(entry.value));
        } else {
            base.entries.push_back(std::move(entry));
        }
    }
    base.mark = over.mark;
}

}  // namespace scree::io
