/* A stack that overflows: the processor must stop it before it changes a static. Ends with 0 if nothing stopped it, so that it ran into other
   memory. */
#include <stdint.h>
#include <stdio.h>

extern uint32_t stack_bottom[], stack_top[];

/* Takes 64 bytes of the stack and more for each level. */
__attribute__((noinline)) static uint32_t descend(uint32_t level) {
    volatile uint32_t taken[16] = {level};
    return level == 0 ? taken[0] : descend(level - 1) + taken[0];
}

int main(void) {
    /* A little more than the stack, and less than the RAM: with other memory below the stack, the call would return. */
    volatile uint32_t levels = (uint32_t)(stack_top - stack_bottom) / 16;
    descend(levels);
    puts("nothing stopped it");
    return 0;
}
