execute_process(COMMAND git -C ${SOURCE} rev-parse --short=12 HEAD OUTPUT_VARIABLE revision
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE no_git)
execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no OUTPUT_VARIABLE changes
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(no_git OR NOT revision)
  set(revision "unknown")
endif()
if(changes)
  set(dirty true)
else()
  set(dirty false)
endif()
set(text "// Made by the build. Do not edit.
#pragma once
namespace scree::version {
inline constexpr const char* kVersion = \"${VERSION}\";
inline constexpr const char* kGitRevision = \"${revision}\";
inline constexpr bool kGitDirty = ${dirty};
inline constexpr const char* kBuildType = \"${BUILD_TYPE}\";
inline constexpr const char* kCompiler = \"${COMPILER}\";
inline constexpr const char* kFlags = \"${FLAGS}\";
inline constexpr const char* kEigen = \"${EIGEN}\";
inline constexpr const char* kHdf5 = \"${HDF5}\";
inline constexpr const char* kYamlCpp = \"${YAML}\";
inline constexpr const char* kMpi = \"${MPI}\";
inline constexpr const char* kCgal = \"${CGAL}\";
}  // namespace scree::version
")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT "${old}" STREQUAL "${text}")
  file(WRITE ${OUTPUT} "${text}")
endif()
