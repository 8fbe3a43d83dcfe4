#include "io/terrain/gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>

#include "core/errors.hpp"

namespace scree::io {
namespace {

constexpr int kGzip = 15 + 16;  // the widest window, with gzip's header
constexpr std::size_t kPiece = std::size_t{1} << 18;
constexpr std::size_t kMostInput = std::size_t{1} << 30;  // zlib counts in unsigned ints

struct Stream : z_stream {
    Stream() : z_stream{} {}
    // The next piece of what is left to be read.
    void feed(std::string_view& rest) {
        if (avail_in > 0) return;
        const std::size_t n = std::min(rest.size(), kMostInput);
        next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest.data()));
        avail_in = static_cast<uInt>(n);
        rest.remove_prefix(n);
    }
    // Room for one more piece, and what was written to the last one.
    template <class Work>
    int write_to(std::string& out, Work work) {
        const std::size_t had = out.size();
        out.resize(had + kPiece);
        next_out = reinterpret_cast<Bytef*>(out.data() + had);
        avail_out = static_cast<uInt>(kPiece);
        const int code = work();
        out.resize(had + kPiece - avail_out);
        return code;
    }
};

struct Inflate : Stream {
    Inflate() { SCREE_CHECK(inflateInit2(this, kGzip) == Z_OK); }
    ~Inflate() { inflateEnd(this); }
};
struct Deflate : Stream {
    Deflate() { SCREE_CHECK(deflateInit2(this, 6, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) == Z_OK); }
    ~Deflate() { deflateEnd(this); }
};

}  // namespace

bool is_gzip(std::string_view bytes) {
    return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

// A file may hold several parts, one after the other.
std::string gunzip(std::string_view packed, const std::string& path) {
    Inflate stream;
    std::string out;
    std::string_view rest = packed;
    for (;;) {
        stream.feed(rest);
        const int code = stream.write_to(out, [&] { return inflate(&stream, Z_NO_FLUSH); });
        if (code == Z_STREAM_END) {
            stream.feed(rest);
            if (stream.avail_in == 0) return out;
            SCREE_CHECK(inflateReset(&stream) == Z_OK);
        } else if (code == Z_BUF_ERROR && stream.avail_in == 0 && rest.empty()) {
            throw IoError(path + ": the gzip data ends too early: the file is not whole");
        } else if (code != Z_OK && code != Z_BUF_ERROR) {
            throw IoError(path + ": the gzip data is damaged" +
                          (stream.msg != nullptr ? std::string(": ") + stream.msg : ""));
        }
    }
}

std::string gzip(std::string_view bytes) {
    Deflate stream;
    std::string out;
    std::string_view rest = bytes;
    for (int code = Z_OK; code != Z_STREAM_END;) {
        stream.feed(rest);
        code = stream.write_to(out, [&] { return deflate(&stream, rest.empty() ? Z_FINISH : Z_NO_FLUSH); });
        SCREE_CHECK(code == Z_OK || code == Z_BUF_ERROR || code == Z_STREAM_END);
    }
    return out;
}

}  // namespace scree::io
