# Makes core/version.hpp in the build tree: version, git revision, compiler, flags, library versions. Rewritten at each
# build, only if it changed.
set(SCREE_VERSION_DIR ${CMAKE_BINARY_DIR}/generated)
string(TOUPPER "${CMAKE_BUILD_TYPE}" _type)
set(SCREE_ALL_FLAGS "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${_type}} native=${SCREE_NATIVE} assertions=${SCREE_ASSERTIONS}")
string(STRIP "${SCREE_ALL_FLAGS}" SCREE_ALL_FLAGS)
add_custom_target(scree_version BYPRODUCTS ${SCREE_VERSION_DIR}/core/version.hpp
  COMMAND ${CMAKE_COMMAND}
    -D SOURCE=${PROJECT_SOURCE_DIR} -D OUTPUT=${SCREE_VERSION_DIR}/core/version.hpp
    -D "VERSION=${PROJECT_VERSION}" -D "BUILD_TYPE=${CMAKE_BUILD_TYPE}"
    -D "COMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}" -D "FLAGS=${SCREE_ALL_FLAGS}"
    -D "EIGEN=${Eigen3_VERSION}" -D "HDF5=${HDF5_VERSION}" -D "YAML=${yaml-cpp_VERSION}" -D "MPI=${MPI_C_VERSION}"
    -D "CGAL=${CGAL_VERSION}"
    -P ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake
  COMMENT "Version" VERBATIM)
