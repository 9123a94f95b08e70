/* The C recipe of docs/cookbook.md (recipe.c), with a flash in memory: a new board begins, and a stored model comes back. */
#include "goodbot.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static _Alignas(8) unsigned char memory[GOODBOT_SMALL_BYTES];
static unsigned char cells[2 * 4096];

static void must(goodbot_status status) {
    if (status != GOODBOT_STATUS_OK) {
        printf("%s\n", goodbot_status_text(status));
        exit(1);
    }
}

static bool read_flash(void *context, uint32_t at, uint8_t *to, uint32_t bytes) {
    (void)context;
    memcpy(to, cells + at, bytes);
    return true;
}

static bool write_flash(void *context, uint32_t at, const uint8_t *from, uint32_t bytes) {
    (void)context;
    memcpy(cells + at, from, bytes);
    return true;
}

static bool erase_flash(void *context, uint32_t at, uint32_t bytes) {
    (void)context;
    memset(cells + at, 0xff, bytes);
    return true;
}

#include "recipe.c"

static goodbot *made(void) {
    goodbot *robot;
    goodbot_capacities capacities;
    must(goodbot_preset(GOODBOT_SMALL, &capacities));
    must(goodbot_init_home(memory, sizeof memory, &capacities, &robot));
    must(goodbot_home_begin(robot));
    must(goodbot_home_room(robot, "room0", 0, 0, 8, 4, "red"));
    must(goodbot_home_room(robot, "room1", 0, 4, 8, 8, "green"));
    must(goodbot_home_door(robot, "door0", 2, 4, 2, 4));
    must(goodbot_home_agent(robot, "agent0", 4, 2));
    must(goodbot_home_build(robot));
    wake(robot);
    return robot;
}

int main(void) {
    goodbot *robot;
    uint32_t sessions = 0;
    memset(cells, 0xff, sizeof cells);
    robot = made();
    must(goodbot_hear(robot, "go to the green room"));
    must(goodbot_finish(robot, NULL));
    while (goodbot_learn(robot, 100) == GOODBOT_STATUS_WORKING) {
    }
    keep(robot);
    must(goodbot_session_count(made(), &sessions));
    printf("%u session came back\n", (unsigned)sessions);
    return 0;
}
