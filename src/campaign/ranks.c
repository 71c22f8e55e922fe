/* Start and end of the parallel machine. */
#include <mpi.h>
#include <stdlib.h>
#include <string.h>

#include "campaign/protocol.h"
#include "campaign/signals.h"
#include "floewear/campaign.h"

/* Defaults for Open MPI, given through the environment because that is read inside MPI_Init; a user's own settings win.
 *
 * Alone: no daemon is forked and no network is opened (five times faster to start, works in a bare container).
 * All ranks on one machine: shared memory only. Otherwise the transports are Open MPI's own choice. */
static void ranks_set_defaults(void)
{
    const char *size        = getenv("OMPI_COMM_WORLD_SIZE");
    const char *local       = getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
    bool        is_launched = size || getenv("PMIX_RANK") || getenv("PMI_RANK") || getenv("PMI_SIZE");

    if (!is_launched) {
        setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
        setenv("OMPI_MCA_pml", "ob1", 0);
        setenv("OMPI_MCA_btl", "self", 0);
        /* All that run alone share one session folder; two that start and end together take it from each other. */
        setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
    } else if (size && local && strcmp(size, local) == 0) {
        setenv("OMPI_MCA_pml", "ob1", 0);
        setenv("OMPI_MCA_btl", "self,vader", 0);
        /* Reading another process's memory directly is forbidden in many containers and gains nothing at 12 kB. */
        setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
    }
}

fw_status fw_ranks_start(int *argc, char ***argv, int *rank, int *n_ranks, fw_msg *m)
{
    int provided = 0;

    ranks_set_defaults();
    FW_CHECK(MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided) == MPI_SUCCESS, m, FW_E_INTERNAL,
             "MPI could not be started");
    *rank    = fw_protocol_rank();
    *n_ranks = fw_protocol_ranks();
    fw_signals_catch();
    return FW_OK;
}

void fw_ranks_stop(void)
{
    int n;

    if (!fw_protocol_is_on()) return;
    n = fw_protocol_ranks();
    if (fw_protocol_rank() == 0) {
        for (int r = 1; r < n; r++) MPI_Send(NULL, 0, MPI_BYTE, r, FW_TAG_BYE, MPI_COMM_WORLD);
    } else {
        fw_nap nap        = {0};
        int    is_waiting = 0;

        /* Rank 0 may still be writing results, on a core that MPI_Finalize's busy waiting would take from it. */
        for (;;) {
            MPI_Iprobe(0, FW_TAG_BYE, MPI_COMM_WORLD, &is_waiting, MPI_STATUS_IGNORE);
            if (is_waiting) break;
            fw_nap_take(&nap);
        }
        MPI_Recv(NULL, 0, MPI_BYTE, 0, FW_TAG_BYE, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    }
    MPI_Finalize();
}

void fw_ranks_abort(int exit_code)
{
    if (fw_protocol_is_on()) MPI_Abort(MPI_COMM_WORLD, exit_code);
    _Exit(exit_code);
}

void fw_campaign_cancel(void)
{
    fw_protocol_begin(0, false);
}
