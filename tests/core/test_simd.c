// The vector operations of core/cpu/simd.h do the same for every instruction set that this processor runs.
#include "common/build.h"

const char *weir_test_simd_base(void);
const char *weir_test_simd_avx2(void);
const char *weir_test_simd_avx512(void);
const char *weir_test_simd_avx512vl(void);

static void check_operations(const char *set, const char *wrong)
{
    if (wrong) fail_msg("%s: %s", set, wrong);
}

static void operations_do_what_they_say(void **state)
{
    (void)state;
    check_operations("base", weir_test_simd_base());
#if defined(WEIR_SIMD_AVX2)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2")) check_operations("AVX2", weir_test_simd_avx2());
    if (__builtin_cpu_supports("avx512f")) check_operations("AVX-512", weir_test_simd_avx512());
    if (__builtin_cpu_supports("avx512vl")) check_operations("AVX-512VL", weir_test_simd_avx512vl());
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(operations_do_what_they_say)};
    return cmocka_run_group_tests_name("simd", tests, NULL, NULL);
}
