# Writes the bytes of INPUT as the C array SYMBOL, ended by a 0, into OUTPUT. An array, not a string: ISO C allows
# compilers to refuse string literals of more than 4,095 characters. WGSL goes without its comments and
# indentation, which would be a ninth of weir.wasm; its lines keep their numbers.
if(INPUT MATCHES "\\.wgsl$")
  file(READ ${INPUT} text)
  string(REGEX REPLACE " *//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "\n +" "\n" text "${text}")
  string(HEX "${text}" bytes)
else()
  file(READ ${INPUT} bytes HEX)
endif()
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "(................................................................................)" "\\1\n"
       bytes "${bytes}")
file(WRITE ${OUTPUT} "extern const char ${SYMBOL}[];\nconst char ${SYMBOL}[] = {\n${bytes}0};\n")
