#include "solvers/warm_start.hpp"

namespace scree::solvers {

void match_warm_start(const contact::ContactSet& contacts, const WarmStart& last, double step, bool frictional,
                      std::vector<Vec3>& impulse, std::vector<double>& normal, std::vector<std::uint32_t>* unmatched) {
    const double ratio = last.step > 0.0 ? step / last.step : 1.0;
    const std::size_t count = last.key.size();
    std::size_t k = 0;
    const auto skip = [&] {
        if (unmatched != nullptr) unmatched->push_back(static_cast<std::uint32_t>(k));
        ++k;
    };
    for (std::size_t c = 0; c < contacts.size() && k < count; ++c) {
        while (k < count && last.key[k] < contacts[c].key) skip();
        if (k == count || last.key[k] != contacts[c].key) continue;
        if (!frictional) {
            normal[c] = ratio * last.impulse_normal[k];
        } else if (last.impulse_vector[k].dot(contacts[c].normal) > 0.0) {
            impulse[c] = ratio * last.impulse_vector[k];
        }
        ++k;
    }
    while (k < count) skip();
}

void keep_for_warm_start(const contact::ContactSet& contacts, const std::vector<Vec3>& impulse,
                         const std::vector<double>& normal, double step, WarmStart& kept) {
    kept.key.clear();
    kept.impulse_vector.clear();
    kept.impulse_normal.clear();
    kept.step = step;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        if (!impulse.empty() && !impulse[c].isZero(0.0)) {
            kept.key.push_back(contacts[c].key);
            kept.impulse_vector.push_back(impulse[c]);
        } else if (!normal.empty() && normal[c] != 0.0) {
            kept.key.push_back(contacts[c].key);
            kept.impulse_normal.push_back(normal[c]);
        }
    }
}

}  // namespace scree::solvers
