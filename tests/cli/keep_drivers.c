// Part of `weir` under the leak sanitizer only: Vulkan drivers keep some memory in their globals for as
// long as they are loaded. The loader unloads them before the sanitizer looks, so that memory seems
// lost; they stay loaded here. (The tests in C do it in tests/gpu/adapter.c.)
int dlclose(void *library);

int dlclose(void *library)
{
    (void)library;
    return 0;
}
