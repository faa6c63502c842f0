// The bodies of tests/common on the CPU solver.
#include "common/shared.h"

int main(int argc, char **argv)
{
    return weir_shared_main(argc, argv, weir_cpu_backend());
}
