/* Starts a C program on the emulated board; its output and its exit code go through semihosting. */
#include <stdint.h>
#include <stdlib.h>

extern uint32_t data_begin[], data_end[], data_source[], bss_begin[], bss_end[], stack_top[];
extern void initialise_monitor_handles(void);
extern int main(void);

void start(void) {
    *(volatile uint32_t *)0xE000ED88 |= 0xF << 20; /* the floating-point unit on */
    for (uint32_t *to = data_begin, *from = data_source; to < data_end;) *to++ = *from++;
    for (uint32_t *to = bss_begin; to < bss_end;) *to++ = 0;
    initialise_monitor_handles();
    exit(main());
}

void fault(void) { _Exit(99); }

__attribute__((section(".vectors"), used)) static const struct {
    uint32_t *top;
    void (*handlers[6])(void);
} vectors = {stack_top, {start, fault, fault, fault, fault, fault}};

/* What newlib looks for and a static program without constructors does not need. */
void _init(void) {}
void _fini(void) {}
