// The corners of a patch of contact, seen along its normal, and which of them stay. Private to this folder.
#pragma once

#include <array>
#include <span>

#include "contact/polyhedra/manifold.hpp"

namespace scree::contact::detail {

struct Corner {
    double u, v;    // [m] across the normal
    double height;  // [m] along the normal, half-way between the surfaces
    double gap;     // [m]
    FeatureKey key;
    bool shallow = false;  // of two edges that lie on one another nearly all along
};

class Corners {
  public:
    // Corners nearer than `same` are one; `margin` is the largest gap that is added.
    Corners(double same, double margin) : same_square_(same * same), margin_(margin) {}

    // Of two that are one the deeper stays, with its key or that of a kind that comes before (Meeting).
    void add(const Corner& corner);
    // Leaves out shallow corners on the straight way between two others: the next round-off would move or remove them.
    void straighten(double round_off);
    void reduce(int most);
    double hull_area() const;

    int size() const { return size_; }
    const Corner& operator[](int i) const { return item_[static_cast<std::size_t>(i)]; }

  private:
    static constexpr int kRoom = 48;

    int deepest() const;
    bool straight(const Corner& corner, double depth) const;
    int hull(std::array<int, kRoom>& order) const;  // counter-clockwise; returns how many
    int smallest_ear(std::span<const int> hull, int keep) const;
    void remove(int i);

    std::array<Corner, kRoom> item_;
    int size_ = 0;
    double same_square_, margin_;
};

}  // namespace scree::contact::detail
