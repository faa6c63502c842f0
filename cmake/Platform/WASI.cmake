# CMake 3.25 does not know WASI: a system with static libraries and no more to say.
set(WASI 1)
