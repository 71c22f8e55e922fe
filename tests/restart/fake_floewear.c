/* `floewear run` over the stand-in simulation: everything but the kernel is the real program. */
#include "campaign/fake_realisation.h"
#include "cli/commands.h"

int main(int argc, char **argv)
{
    fw_fake_from_environment();
    return argc < 2 ? 2 : fw_cmd_run(argc - 1, argv + 1);
}
