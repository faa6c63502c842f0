# weir_embed_wgsl(TARGET FILE...): compiles WGSL files, named relative to shaders/, into TARGET.
# shaders/solve/density.wgsl becomes `extern const char weir_wgsl_solve_density[];`, ended by a 0.
function(weir_embed_wgsl target)
  foreach(shader ${ARGN})
    string(REGEX REPLACE "\\.wgsl$" "" symbol ${shader})
    string(REGEX REPLACE "[^A-Za-z0-9]" "_" symbol ${symbol})
    set(input ${CMAKE_SOURCE_DIR}/shaders/${shader})
    set(output ${CMAKE_CURRENT_BINARY_DIR}/wgsl/${symbol}.c)
    add_custom_command(
      OUTPUT ${output}
      COMMAND ${CMAKE_COMMAND} -DINPUT=${input} -DOUTPUT=${output} -DSYMBOL=weir_wgsl_${symbol}
              -P ${CMAKE_SOURCE_DIR}/cmake/embed_file.cmake
      DEPENDS ${input} ${CMAKE_SOURCE_DIR}/cmake/embed_file.cmake
      COMMENT "Embedding shaders/${shader}"
      VERBATIM)
    target_sources(${target} PRIVATE ${output})
  endforeach()
endfunction()
