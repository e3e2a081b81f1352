/* A host without Python of its own, as fmusim and OMSimulator are: one instance of an FMU 2.0 from its library.
 *
 * native_host LIBRARY RESOURCES_URI GUID STEPS
 *
 * libpython is in the process (LD_PRELOAD), as for any such host. Ends with 0, or with the number of the call
 * that did not return fmi2OK; a crash at the end of the process ends it by a signal.
 */
#include <dlfcn.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

typedef void *Component;
typedef struct {
    void (*logger)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*finished)(void *, int);
    void *environment;
} Callbacks;

static void say(void *environment, const char *name, int status, const char *category, const char *text, ...)
{
    va_list rest;
    (void)environment, (void)category;
    va_start(rest, text);
    fprintf(stderr, "%s (%d): ", name, status);
    vfprintf(stderr, text, rest);
    fputc('\n', stderr);
    va_end(rest);
}

static void *symbol(void *library, const char *name)
{
    void *found = dlsym(library, name);
    if (!found) {
        fprintf(stderr, "%s\n", dlerror());
        exit(90);
    }
    return found;
}

int main(int count, char **given)
{
    if (count != 5)
        return 91;
    void *library = dlopen(given[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        return 92;
    }
    Component (*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int) =
        symbol(library, "fmi2Instantiate");
    int (*setup)(Component, int, double, double, int, double) = symbol(library, "fmi2SetupExperiment");
    int (*enter)(Component) = symbol(library, "fmi2EnterInitializationMode");
    int (*leave)(Component) = symbol(library, "fmi2ExitInitializationMode");
    int (*step)(Component, double, double, int) = symbol(library, "fmi2DoStep");
    int (*terminate)(Component) = symbol(library, "fmi2Terminate");
    void (*release)(Component) = symbol(library, "fmi2FreeInstance");

    static Callbacks callbacks = {say, calloc, free, NULL, NULL};
    Component unit = instantiate("unit", 1, given[3], given[2], &callbacks, 0, 1);
    if (!unit)
        return 1;
    if (setup(unit, 0, 0.0, 0.0, 0, 0.0))
        return 2;
    if (enter(unit))
        return 3;
    if (leave(unit))
        return 4;
    for (int i = 0; i < atoi(given[4]); i++)
        if (step(unit, 1e-4 * i, 1e-4, 1))
            return 5;
    if (terminate(unit))
        return 6;
    release(unit);
    dlclose(library);
    return 0;
}
