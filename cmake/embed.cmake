# weir_embed_file(TARGET FILE SYMBOL): compiles FILE (relative to the source folder) into TARGET as
# `extern const char SYMBOL[];`, ended by a 0.
function(weir_embed_file target file symbol)
  set(input ${CMAKE_SOURCE_DIR}/${file})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded/${symbol}.c)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DINPUT=${input} -DOUTPUT=${output} -DSYMBOL=${symbol}
            -P ${CMAKE_SOURCE_DIR}/cmake/embed_file.cmake
    DEPENDS ${input} ${CMAKE_SOURCE_DIR}/cmake/embed_file.cmake
    COMMENT "Embedding ${file}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()

# weir_embed_wgsl(TARGET FILE...): compiles WGSL files, named relative to shaders/, into TARGET.
# shaders/solve/density.wgsl becomes `extern const char weir_wgsl_solve_density[];`.
function(weir_embed_wgsl target)
  foreach(shader ${ARGN})
    string(REGEX REPLACE "\\.wgsl$" "" symbol ${shader})
    string(REGEX REPLACE "[^A-Za-z0-9]" "_" symbol ${symbol})
    weir_embed_file(${target} shaders/${shader} weir_wgsl_${symbol})
  endforeach()
endfunction()
