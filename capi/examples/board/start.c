/* Starts a C program on the emulated board; its output and its exit code go through semihosting. At the end it reports the deepest stack,
   by the paint that was overwritten, and the instructions, by a counter that the emulator advances by the same time for each.
   A program that uses no more of stdio than `puts` is linked without it. */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

extern uint32_t data_begin[], data_end[], data_source[], bss_begin[], bss_end[], stack_bottom[], stack_top[];
extern char end[], heap_end[];
extern int main(void);
/* Present only if the program uses more of stdio than `puts`. */
extern void initialise_monitor_handles(void) __attribute__((weak));
extern int fflush(FILE *stream) __attribute__((weak));

#define PAINT 0xCCCCCCCCu

/* SysTick: control, reload and current value. It counts 25 million times a second down from its reload value, and an instruction takes 64 ns. */
static volatile uint32_t *const systick = (volatile uint32_t *)0xE000E010;
#define PERIOD 0x1000000u
static volatile uint32_t periods;

static void tick(void) { periods++; }

/* Since the start. A program may declare it, too. */
uint32_t instructions(void);
uint32_t instructions(void) {
    uint32_t before, left;
    do {
        before = periods;
        left = systick[2];
    } while (periods != before);
    return (uint32_t)(((uint64_t)before * PERIOD + (PERIOD - left)) * 25 / 40);
}

static uint32_t deepest(void) {
    uint32_t *at = stack_bottom;
    while (at < stack_top && *at == PAINT) at++;
    return (uint32_t)(stack_top - at) * 4;
}

static void semihost(uint32_t operation, const void *with) {
    register uint32_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = with;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

static void print(const char *text) { semihost(4, text); }

int puts(const char *text) {
    if (fflush) fflush(NULL);
    print(text);
    print("\n");
    return 1;
}

static void report(const char *name, uint32_t number) {
    char line[] = "           \n", *at = line + 11;
    do *--at = (char)('0' + number % 10);
    while (number /= 10);
    *--at = ' ';
    print(name);
    print(at);
}

static void leave(int code) {
    const uint32_t reason_and_code[] = {0x20026, (uint32_t)code};
    for (;;) semihost(0x20, reason_and_code);
}

void start(void) {
    *(volatile uint32_t *)0xE000ED88 |= 0xF << 20; /* the floating-point unit on */
    for (uint32_t *to = data_begin, *from = data_source; to < data_end;) *to++ = *from++;
    for (uint32_t *to = bss_begin; to < bss_end;) *to++ = 0;
    uintptr_t here = (uintptr_t)__builtin_frame_address(0);
    for (volatile uint32_t *to = stack_bottom; (uintptr_t)to < here - 256;) *to++ = PAINT;
    if (initialise_monitor_handles) initialise_monitor_handles();
    systick[1] = PERIOD - 1;
    systick[2] = 0;
    systick[0] = 7;
    int code = main();
    uint32_t taken = instructions(), stack = deepest();
    if (fflush) fflush(NULL);
    report("stack", stack);
    report("instructions", taken);
    leave(code);
}

__attribute__((used)) static void faulted(void) { leave(102); }

/* The stack may be what failed: it is begun anew. */
__attribute__((naked)) void fault(void) { __asm__ volatile("ldr r0, =stack_top\n mov sp, r0\n b faulted"); }

__attribute__((section(".vectors"), used)) static const struct {
    uint32_t *top;
    void (*handlers[15])(void);
} vectors = {stack_top, {start, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, tick}};

/* newlib's own ends at the stack, which is below the heap here. */
void *_sbrk(ptrdiff_t bytes) {
    static char *at = end;
    if (bytes > heap_end - at) return (void *)-1;
    at += bytes;
    return at - bytes;
}

/* newlib demands these; a static program without constructors does not need them. */
void _init(void) {}
void _fini(void) {}
