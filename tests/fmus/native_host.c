/* A host without Python of its own, as fmusim and OMSimulator are: one instance of an FMU 2.0 from its library.
 *
 * native_host LIBRARY RESOURCES_URI GUID STEPS [REFERENCE VALUE [late]]
 *
 * libpython is in the process (LD_PRELOAD), as for any such host. Sets a Real before initialization, or late.
 * Ends with 0, or with the number of the first call that did not return fmi2OK, after which the instance is freed
 * all the same, as many tools do; a crash at the end of the process ends it by a signal.
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

typedef struct {
    Component unit;
    int (*setup)(Component, int, double, double, int, double);
    int (*enter)(Component);
    int (*leave)(Component);
    int (*set)(Component, const unsigned *, size_t, const double *);
    int (*step)(Component, double, double, int);
    int (*terminate)(Component);
} Calls;

static int drive(const Calls *c, int steps, int count, char **set)
{
    unsigned reference = count > 0 ? (unsigned)atoi(set[0]) : 0;
    double value = count > 1 ? atof(set[1]) : 0.0;
    if (count == 2 && c->set(c->unit, &reference, 1, &value))
        return 7;
    if (c->setup(c->unit, 0, 0.0, 0.0, 0, 0.0))
        return 2;
    if (c->enter(c->unit))
        return 3;
    if (c->leave(c->unit))
        return 4;
    if (count == 3 && c->set(c->unit, &reference, 1, &value))
        return 7;
    for (int i = 0; i < steps; i++)
        if (c->step(c->unit, 1e-4 * i, 1e-4, 1))
            return 5;
    return c->terminate(c->unit) ? 6 : 0;
}

int main(int count, char **given)
{
    if (count < 5)
        return 91;
    void *library = dlopen(given[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        return 92;
    }
    Component (*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int) =
        symbol(library, "fmi2Instantiate");
    void (*release)(Component) = symbol(library, "fmi2FreeInstance");
    Calls calls = {NULL,
                   symbol(library, "fmi2SetupExperiment"),
                   symbol(library, "fmi2EnterInitializationMode"),
                   symbol(library, "fmi2ExitInitializationMode"),
                   symbol(library, "fmi2SetReal"),
                   symbol(library, "fmi2DoStep"),
                   symbol(library, "fmi2Terminate")};

    static Callbacks callbacks = {say, calloc, free, NULL, NULL};
    calls.unit = instantiate("unit", 1, given[3], given[2], &callbacks, 0, 1);
    if (!calls.unit)
        return 1;
    int ended = drive(&calls, atoi(given[4]), count - 5, given + 5);
    release(calls.unit);
    dlclose(library);
    return ended;
}
