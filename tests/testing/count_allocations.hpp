// Counts every allocation of a test program by replacing the global operator new: to be included by one file of it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace scree::testing {

inline std::atomic<std::size_t> allocations{0};

inline void* allocate(std::size_t size, std::size_t align) {
    ++allocations;
    void* p = nullptr;
    if (posix_memalign(&p, align, size == 0 ? 1 : size) != 0) throw std::bad_alloc();
    return p;
}

}  // namespace scree::testing

void* operator new(std::size_t size) {
    return scree::testing::allocate(size, alignof(std::max_align_t));
}
void* operator new[](std::size_t size) {
    return scree::testing::allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t align) {
    return scree::testing::allocate(size, static_cast<std::size_t>(align));
}
void operator delete(void* p) noexcept {
    std::free(p);
}
void operator delete[](void* p) noexcept {
    std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
    std::free(p);
}
void operator delete[](void* p, std::size_t) noexcept {
    std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
    std::free(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
    std::free(p);
}
