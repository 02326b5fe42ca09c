# Copies the libraries that the installed programs need to lib/gable, where their rpath looks. The C
# library and its parts stay the system's: they belong to its kernel and its loader.
file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${programs} RESOLVED_DEPENDENCIES_VAR found
     UNRESOLVED_DEPENDENCIES_VAR missing
     POST_EXCLUDE_REGEXES "/(ld-linux|libc|libm|libpthread|libdl|librt|libresolv)[-.][^/]*$")
if(missing)
  message(FATAL_ERROR "these libraries are not there, so the archive would not run: ${missing}")
endif()
foreach(library ${found})
  file(INSTALL DESTINATION ${prefix}/lib/gable TYPE SHARED_LIBRARY FOLLOW_SYMLINK_CHAIN FILES ${library})
endforeach()
