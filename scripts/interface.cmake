# interface_of(ROOT VARIABLE): a hash of all headers of the tree ROOT, by name and content. The Python module includes headers that
# are not installed; it is linked with an installed library only where the library was built with the same ones.
function(interface_of root variable)
  file(GLOB_RECURSE headers RELATIVE ${root} ${root}/include/*.hpp ${root}/src/*.hpp)
  list(SORT headers)
  set(all "")
  foreach(header IN LISTS headers)
    file(SHA256 ${root}/${header} hash)
    string(APPEND all "${header} ${hash}\n")
  endforeach()
  string(SHA256 hash "${all}")
  set(${variable} ${hash} PARENT_SCOPE)
endfunction()
