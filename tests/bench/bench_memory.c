/* Peak memory (ru_maxrss of a child process): a window alone, the program with one, and the program with many records. */
#include <stdio.h>
#include <unistd.h>

#include "bench/bench.h"

static void window_alone(double concentration, double window)
{
    fflush(stdout);
    pid_t pid = fork();
    if (pid == 0) {
        fw_record r = bench_realise(concentration, 2, window, 0.01, 0, 1);
        fw_record_free(&r);
        _exit(bench_end());
    }
    bench_end_of_child end = bench_wait(pid);
    printf("| a window of %g s at %g %%, library alone | %.1f | |\n", window, 100 * concentration, end.peak_mib);
    bench_expect(end.exit_code == 0 && end.peak_mib > 0 && end.peak_mib < 200, "peak memory %.1f MiB, exit %d", end.peak_mib, end.exit_code);
}

static void program(const char *what, int n_ranks, const char *campaign, const char *const *more)
{
    char               folder[4096];
    bench_end_of_child end;
    bench_make_folder(folder, sizeof folder);
    double took = bench_run_program(folder, "run", n_ranks, campaign, more, &end);
    printf("| %s | %.1f | %.1f |\n", what, end.peak_mib, took);
    bench_expect(end.peak_mib > 0 && end.peak_mib < 200, "%s: peak memory %.1f MiB", what, end.peak_mib);
    bench_remove_folder(folder);
}

int main(int argc, char **argv)
{
    bool is_quick = bench_start(argc, argv);
    printf("### Peak memory\n\n");
    printf("Largest resident set of any process of the run; wanted: below 200 MiB per rank.\n\n");
    printf("| run | peak MiB | wall s |\n|---|---|---|\n");
    static const double CONCENTRATION[] = {0.1, 0.4, 0.6};
    for (size_t c = 0; c < 3; c++) window_alone(CONCENTRATION[c], is_quick ? 60 : 3 * 3600);

    const char *paper = FW_SOURCE_DIR "/campaigns/paper-60s.yaml", *raahe = FW_SOURCE_DIR "/campaigns/raahe.yaml";
    const char *const window[] = {"--set", is_quick ? "exposure.window=60s" : "exposure.window=3h", "--set", "ice.concentration=60%",
                                  "--set", "precision.max_realisations=2", NULL};
    program("floewear run, 2 windows at 60 %, without mpirun", 0, paper, window);
    program("floewear run, 2 windows at 60 %, 2 ranks", 2, paper, window);
    const char *const many[] = {"--set", "exposure.window=1s", "--set", "exposure.warm_up=0s", "--set",
                                is_quick ? "precision.max_realisations=200" : "precision.max_realisations=4000", "--set", "precision.half_width=0%", NULL};
    program(is_quick ? "raahe with 200 short windows: journal, results.h5, report" : "raahe with 4000 short windows: journal, results.h5, report", 2, raahe,
            many);
    printf("\n");
    return bench_end();
}
