# Found by find_package(HDF5) before CMake's own module of that name, which compiles a program with h5pcc: a shell script
# that fails where the build folder has a space in its path. pkg-config knows the same. Where it has no entry for HDF5
# with MPI, CMake's module does the work.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_search_module(SCREE_HDF5 QUIET IMPORTED_TARGET hdf5-openmpi hdf5-mpich hdf5-mpi)
endif()
if(NOT SCREE_HDF5_FOUND)
  include(${CMAKE_ROOT}/Modules/FindHDF5.cmake)
  return()
endif()

set(HDF5_VERSION ${SCREE_HDF5_VERSION})
set(HDF5_IS_PARALLEL TRUE)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(HDF5 REQUIRED_VARS SCREE_HDF5_LINK_LIBRARIES VERSION_VAR HDF5_VERSION)
if(NOT TARGET hdf5::hdf5)
  add_library(hdf5::hdf5 INTERFACE IMPORTED)
  target_link_libraries(hdf5::hdf5 INTERFACE PkgConfig::SCREE_HDF5)
endif()
