// A vector whose storage starts on a cache line.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace scree {

template <class T>
struct LineAllocator {
    using value_type = T;
    static constexpr std::align_val_t kAlign{64};

    LineAllocator() = default;
    template <class U>
    LineAllocator(const LineAllocator<U>&) {}
    T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kAlign)); }
    void deallocate(T* p, std::size_t) { ::operator delete(p, kAlign); }
    bool operator==(const LineAllocator&) const { return true; }
};

template <class T>
using LineVector = std::vector<T, LineAllocator<T>>;

}  // namespace scree
