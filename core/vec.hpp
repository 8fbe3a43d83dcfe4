// Vectors in the world frame. Positions are held relative to the scene's local origin (see scene.hpp).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace scree {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;  // (w, x, y, z) in every file and message

}  // namespace scree
