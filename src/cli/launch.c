/* `--ranks N`: mpirun starts this program N times, and this process stands for all of them: what
 * stops it stops them, and its exit status is theirs. To mpirun the ranks end with 0, whatever the
 * verdict: a status of another kind is an accident to it, and the last words would be its own. The
 * verdict comes through a file. */
#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/memory.h"
#include "cli/cli.h"

/* The mpirun of the MPI that the program was built with; "" without one. */
#ifndef BOLIDE_MPIRUN
#define BOLIDE_MPIRUN ""
#endif

/* In the environment of a rank that was started so: where its status goes. */
static const char status_variable[] = "BOLIDE_STATUS_FILE";

bool launch_has_made_us(void) { return getenv(status_variable) != NULL; }

int launch_tell_status(const struct ranks *ranks, int status)
{
    const char *path = getenv(status_variable);
    if (!path || ranks->rank != 0)
        return path ? EXIT_OK : status;
    char text[16];
    const int length = snprintf(text, sizeof text, "%d\n", status);
    const int file = open(path, O_WRONLY | O_CLOEXEC);
    const bool told = file >= 0 && write(file, text, (size_t)length) == length;
    if (file >= 0)
        close(file);
    return told ? EXIT_OK : status;
}

struct error *launch_check(const struct ranks *ranks, int64_t wanted)
{
    if (!*BOLIDE_MPIRUN)
        return error_new(ERROR_INPUT, "--ranks: this bolide was built without MPI");
    if (ranks->joined && ranks->size != wanted)
        return error_new(ERROR_INPUT,
                         "--ranks %lld: mpirun has started %d rank%s already; give the number to "
                         "one of them",
                         (long long)wanted, ranks->size, ranks->size == 1 ? "" : "s");
    if (!ranks->joined && launch_has_made_us())
        return error_new(ERROR_SYSTEM,
                         "--ranks: mpirun does not start this program as a rank: it belongs to "
                         "another MPI; set BOLIDE_MPIRUN to the one bolide was built with");
    return NULL;
}

/* What starts ranks: the user's choice, the one of the build, the first in PATH. */
static const char *launcher(void)
{
    const char *given = getenv("BOLIDE_MPIRUN");
    if (given && *given)
        return given;
    return access(BOLIDE_MPIRUN, X_OK) == 0 ? BOLIDE_MPIRUN : "mpirun";
}

static int processors(void)
{
    cpu_set_t set;
    return sched_getaffinity(0, sizeof set, &set) ? 1 : CPU_COUNT(&set);
}

/* For Open MPI, which by default refuses to run as root or more ranks than cores, binds two ranks
 * of every job to the same first cores, and keeps a core busy while it waits. What the user sets
 * wins. */
static void prepare_environment(int64_t ranks)
{
    char threads[16];
    const int each = (int)(processors() / ranks);
    snprintf(threads, sizeof threads, "%d", each > 1 ? each : 1);
    setenv("OMP_NUM_THREADS", threads, 0);
    if (!isatty(STDOUT_FILENO)) /* that of a rank is one */
        setenv("NO_COLOR", "1", 0);
    if (geteuid() == 0) {
        setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
        setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
    }
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 0);
    setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 0);
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
    setenv("OMPI_MCA_btl_base_warn_component_unused", "0", 0);
}

/* Signals that this process waits for, and does not take otherwise. */
static sigset_t signals_to_handle(void)
{
    static const int handled[] = {SIGCHLD, SIGUSR1, SIGTSTP, SIGCONT, SIGINT,
                                  SIGTERM, SIGHUP,  SIGQUIT, SIGXCPU};
    sigset_t set;
    sigemptyset(&set);
    for (size_t i = 0; i < COUNT_OF(handled); i++)
        sigaddset(&set, handled[i]);
    return set;
}

/* Becomes mpirun, in a group of its own: of a terminal's Ctrl-C it must not hear, since it kills
 * its ranks a second after one. It ends with this process. */
static void become(char **words, const sigset_t *mask, int failure)
{
    const int nothing = open("/dev/null", O_RDONLY);
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    dup2(nothing, STDIN_FILENO);
    sigprocmask(SIG_SETMASK, mask, NULL);
    execvp(words[0], words);
    const int number = errno;
    _exit(write(failure, &number, sizeof number) == sizeof number ? ERROR_SYSTEM : EXIT_USAGE);
}

/* Starts WORDS; its process at *CHILD. */
static struct error *start(char **words, const sigset_t *mask, pid_t *child)
{
    int ends[2], number;
    if (pipe2(ends, O_CLOEXEC))
        return error_new(ERROR_SYSTEM, "%s: %s", words[0], strerror(errno));
    fflush(NULL);
    *child = fork();
    if (*child == 0)
        become(words, mask, ends[1]);
    number = *child < 0 ? errno : 0;
    close(ends[1]);
    if (*child > 0 && read(ends[0], &number, sizeof number) == sizeof number)
        waitpid(*child, NULL, 0);
    else if (*child > 0)
        number = 0;
    close(ends[0]);
    return number
               ? error_new(ERROR_SYSTEM,
                           "--ranks: %s, which starts ranks, cannot be run: %s; install Open MPI, "
                           "or set BOLIDE_MPIRUN",
                           words[0], strerror(number))
               : NULL;
}

/* Until CHILD ends; its status as of waitpid. mpirun passes SIGUSR2 on, which asks ranks to stop
 * (signals.c), and kills them after a SIGTERM, which a later request sends. *STOP is the signal
 * that asked first, or zero. */
static int attend(pid_t child, const sigset_t *handled, int *stop)
{
    const double patience = 3.0; /* s: some senders signal twice at once */
    double asked = 0.0;
    for (int status;;) {
        const int number = sigwaitinfo(handled, NULL);
        if (number == SIGCHLD) {
            if (waitpid(child, &status, WNOHANG) == child)
                return status;
        } else if (number == SIGUSR1 || number == SIGCONT) {
            kill(child, number);
        } else if (number == SIGTSTP) {
            kill(child, number);
            raise(SIGSTOP);
        } else if (number > 0 && !*stop) {
            *stop = number;
            asked = clock_seconds();
            kill(child, SIGUSR2);
        } else if (number > 0 && clock_seconds() - asked >= patience) {
            kill(child, SIGTERM);
        }
    }
}

/* The exit status: that of the ranks in the file at PATH, unless a signal stopped them or they
 * could not tell. */
static int status_of(const char *path, int ended, int stop)
{
    char text[16] = "", *end = text;
    FILE *file = fopen(path, "r");
    const bool any = file && fgets(text, sizeof text, file);
    if (file)
        fclose(file);
    const int number = (int)strtol(text, &end, 10);
    const int told = any && end > text ? number : -1;
    if (stop && (told < 0 || told > 128))
        return 128 + stop;
    if (told >= 0)
        return told;
    const int status = WIFSIGNALED(ended) ? 128 + WTERMSIG(ended) : WEXITSTATUS(ended);
    fprintf(stderr, "bolide: the ranks ended without a verdict; mpirun's exit status: %d\n",
            status);
    return status ? status : ERROR_SYSTEM;
}

/* mpirun -n RANKS and this program, as WORDS call it. */
static char **command_line(int count, char **words, const char *number, const char *program)
{
    enum { BEFORE = 4 };
    char **line = memory_allocate(((size_t)count + BEFORE) * sizeof *line);
    if (!line)
        return NULL;
    line[0] = (char *)launcher();
    line[1] = "-n";
    line[2] = (char *)number;
    line[3] = (char *)program;
    for (int i = 1; i < count; i++)
        line[BEFORE + i - 1] = words[i];
    return line;
}

static int launch(char **line, const char *path)
{
    const sigset_t handled = signals_to_handle();
    sigset_t before;
    pid_t child = -1;
    int stop = 0;
    signal(SIGCHLD, SIG_DFL);
    sigprocmask(SIG_BLOCK, &handled, &before);
    struct error *error = start(line, &before, &child);
    if (error)
        return report_error(error);
    const int ended = attend(child, &handled, &stop);
    return status_of(path, ended, stop);
}

int launch_ranks(int count, char **words, int64_t ranks)
{
    char number[24], program[4096];
    const char *folder = getenv("TMPDIR");
    char *path = text_format("%s/bolide-XXXXXX", folder && *folder ? folder : "/tmp");
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = '\0';
    snprintf(number, sizeof number, "%lld", (long long)ranks);
    char **line = command_line(count, words, number, length > 0 ? program : words[0]);
    const int file = path ? mkstemp(path) : -1;
    int status = ERROR_SYSTEM;
    if (!line || !path) {
        status = report_error(out_of_memory());
    } else if (file < 0) {
        status = report_error(file_error(path, errno));
    } else {
        close(file);
        setenv(status_variable, path, 1);
        prepare_environment(ranks);
        status = launch(line, path);
        unlink(path);
    }
    free(line);
    free(path);
    return status;
}
