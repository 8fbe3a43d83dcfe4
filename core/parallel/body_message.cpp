#include "core/parallel/body_message.hpp"

#include <algorithm>

namespace scree {
namespace {

void put_numbers(Packer& packer, const double* from, int count) {
    packer.put_all(std::span<const double>(from, static_cast<std::size_t>(count)));
}
void get_numbers(Unpacker& unpacker, double* to, int count) {
    for (int k = 0; k < count; ++k) to[k] = unpacker.get<double>();
}

}  // namespace

BodyData body_data(const Bodies& bodies, std::size_t i) {
    BodyData b;
    b.radius = bodies.radius[i];
    b.mass = bodies.mass[i];
    b.material = bodies.material[i];
    b.position = bodies.position[i];
    b.velocity = bodies.velocity[i];
    if (bodies.has_spin()) b.spin = bodies.spin[i];
    if (bodies.has_orientation()) std::copy_n(bodies.orientation[i].coeffs().data(), 4, b.orientation.begin());
    if (bodies.has_shapes()) {
        b.shape = bodies.shape[i];
        b.inertia = bodies.inertia[i];
    }
    return b;
}

void append_body(const BodyData& data, const Bodies::Arrays& arrays, Bodies& bodies) {
    bodies.radius.push_back(data.radius);
    bodies.mass.push_back(data.mass);
    bodies.material.push_back(data.material);
    bodies.position.push_back(data.position);
    bodies.velocity.push_back(data.velocity);
    if (arrays.spin) bodies.spin.push_back(data.spin);
    if (arrays.orientation) {
        bodies.orientation.emplace_back();
        std::copy_n(data.orientation.begin(), 4, bodies.orientation.back().coeffs().data());
    }
    if (arrays.shape) {
        bodies.shape.push_back(data.shape);
        bodies.inertia.push_back(data.inertia);
    }
}

Bodies::Arrays arrays_of_all(const Bodies& bodies, const Communicator& ranks) {
    const Bodies::Arrays own = bodies.arrays();
    std::array<std::uint64_t, 3> any{own.spin ? 1U : 0U, own.orientation ? 1U : 0U, own.shape ? 1U : 0U};
    ranks.max(std::span(any));
    return {any[0] != 0, any[1] != 0, any[2] != 0};
}

bool BodyMessage::held_by(int rank) const {
    return holders.empty() ? rank == owner : std::binary_search(holders.begin(), holders.end(), rank);
}

void BodyMessage::put(Packer& packer, bool with_data, const Bodies::Arrays& arrays) const {
    packer.put(id);
    packer.put(owner);
    packer.put(room);
    packer.put(static_cast<std::uint32_t>(holders.size()));
    packer.put_all(std::span<const int>(holders));
    packer.put(static_cast<std::uint8_t>(with_data ? 1 : 0));
    if (!with_data) return;
    packer.put(data.radius);
    packer.put(data.mass);
    packer.put(data.material);
    put_numbers(packer, data.position.data(), 3);
    put_numbers(packer, data.velocity.data(), 3);
    if (arrays.spin) put_numbers(packer, data.spin.data(), 3);
    if (arrays.orientation) put_numbers(packer, data.orientation.data(), 4);
    if (arrays.shape) {
        packer.put(data.shape);
        put_numbers(packer, data.inertia.data(), 3);
    }
}

BodyMessage BodyMessage::get(Unpacker& unpacker, const Bodies::Arrays& arrays) {
    BodyMessage m;
    m.id = unpacker.get<std::uint64_t>();
    m.owner = unpacker.get<std::int32_t>();
    m.room = unpacker.get<double>();
    m.holders.resize(unpacker.get<std::uint32_t>());
    for (int& rank : m.holders) rank = unpacker.get<int>();
    m.has_data = unpacker.get<std::uint8_t>() != 0;
    if (!m.has_data) return m;
    m.data.radius = unpacker.get<double>();
    m.data.mass = unpacker.get<double>();
    m.data.material = unpacker.get<MaterialIndex>();
    get_numbers(unpacker, m.data.position.data(), 3);
    get_numbers(unpacker, m.data.velocity.data(), 3);
    if (arrays.spin) get_numbers(unpacker, m.data.spin.data(), 3);
    if (arrays.orientation) get_numbers(unpacker, m.data.orientation.data(), 4);
    if (arrays.shape) {
        m.data.shape = unpacker.get<ShapeIndex>();
        get_numbers(unpacker, m.data.inertia.data(), 3);
    }
    return m;
}

}  // namespace scree
