// Materials, and the laws of each pair of them.
#pragma once

#include <string>
#include <vector>

#include "core/errors.hpp"
#include "core/ids.hpp"

namespace scree {

struct Material {
    std::string name;
    double density = 0.0;  // [kg/m3]
};

struct PairLaw {
    double friction = 0.0;     // Coulomb's mu [-]
    double restitution = 0.0;  // Newton's e [-], 0 to 1
};

// A symmetric table with one law for each pair of materials.
class PairTable {
  public:
    PairTable() = default;
    explicit PairTable(std::size_t materials) : n_(materials), laws_(materials * materials) {}

    const PairLaw& operator()(MaterialIndex a, MaterialIndex b) const { return laws_[raw(a) * n_ + raw(b)]; }
    void set(MaterialIndex a, MaterialIndex b, const PairLaw& law) {
        laws_[raw(a) * n_ + raw(b)] = law;
        laws_[raw(b) * n_ + raw(a)] = law;
    }
    std::size_t materials() const { return n_; }
    const std::vector<PairLaw>& all() const { return laws_; }

  private:
    std::size_t n_ = 0;
    std::vector<PairLaw> laws_;  // n x n
};

}  // namespace scree
