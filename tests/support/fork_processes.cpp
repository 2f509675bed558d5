// For builds with the thread sanitizer: Qt starts processes by a clone that shares its memory until it
// executes the program, and the sanitizer takes what it notes in the child for the parent's. A fork copies
// the memory.
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdarg>

extern "C" int clone(int (*child)(void*), void*, int flags, void* argument, ...) {
    std::va_list rest;
    va_start(rest, argument);
    int* const handle = va_arg(rest, int*);
    va_end(rest);
    const pid_t pid = fork();
    if (pid == 0) _exit(child(argument));
    if (pid > 0 && (flags & CLONE_PIDFD) != 0) *handle = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
    return pid;
}
