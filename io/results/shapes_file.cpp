#include "io/results/shapes_file.hpp"

#include <type_traits>

#include "core/parallel/together.hpp"
#include "io/atomic_file.hpp"
#include "io/results/flat_shape_fields.hpp"

namespace scree::io {

void write_shapes(const std::string& path, const std::vector<ConvexShape>& shapes, const Provenance& provenance,
                  int compression, const Communicator& ranks) {
    by_root(ranks, [&] {
        AtomicFile out(path);
        Hdf5File file = Hdf5File::create(out.temporary());
        write_format(file.root(), "scree shapes");
        const Hdf5Group group = file.root().group("shapes");
        const FlatShapes flat = flatten(shapes);
        visit_fields(flat, [&](const char* name, const auto& values, const Meaning& meaning) {
            if constexpr (std::is_same_v<decltype(values), const std::vector<std::uint64_t>&>) {
                // numpy takes no unsigned counts where it repeats or splits
                const std::vector<std::int64_t> counts(values.begin(), values.end());
                write_rows(group, name, rows_of(counts), meaning, {.gzip = compression});
            } else {
                write_rows(group, name, rows_of(values), meaning, {.gzip = compression});
            }
        });
        write_provenance(file.root(), provenance);
        file.close();
        out.commit();
    });
}

}  // namespace scree::io
