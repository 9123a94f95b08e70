/* A robot in a home: trained by reward and punishment, saved, restored into a second robot that obeys at once. */
#include <goodbot.h>
#include <stdio.h>
#include <string.h>

GOODBOT_ALIGNED static unsigned char first_memory[GOODBOT_SMALL_BYTES];
GOODBOT_ALIGNED static unsigned char second_memory[GOODBOT_SMALL_BYTES];
static unsigned char model[4096];

#define TRY(call)                                                                                                                          \
    do {                                                                                                                                   \
        goodbot_status tried = (call);                                                                                                     \
        if (tried != GOODBOT_STATUS_OK) {                                                                                                  \
            printf("%s: %s\n", #call, goodbot_status_text(tried));                                                                         \
            return 1;                                                                                                                      \
        }                                                                                                                                  \
    } while (0)

/* 1. The home: three rooms, two doors. */
static int describe(goodbot *robot) {
    goodbot_status status;
    TRY(goodbot_home_begin(robot));
    TRY(goodbot_home_room(robot, "room0", 0, 0, 8, 4, "red"));
    TRY(goodbot_home_room(robot, "room1", 0, 4, 4, 8, "green"));
    TRY(goodbot_home_room(robot, "room2", 4, 4, 8, 8, "blue"));
    TRY(goodbot_home_door(robot, "door0", 2, 4, 2, 4));
    TRY(goodbot_home_door(robot, "door1", 6, 4, 6, 4));
    TRY(goodbot_home_agent(robot, "agent0", 4, 2));
    while ((status = goodbot_home_find_cells(robot, 16)) == GOODBOT_STATUS_WORKING) {
    }
    TRY(status);
    TRY(goodbot_home_build(robot));
    return 0;
}

/* 2. One step: plan in small parts, decide, act. In a real robot, other work is done between the parts. */
static int step(goodbot *robot, uint8_t *action) {
    goodbot_status status;
    while ((status = goodbot_plan(robot, 50)) == GOODBOT_STATUS_WORKING) {
    }
    TRY(status);
    TRY(goodbot_decide(robot, action, NULL));
    return 0;
}

static int is_in(goodbot *robot, int left, int right, int bottom) {
    int32_t x = 0, y = 0;
    return goodbot_home_where(robot, "agent0", &x, &y) == GOODBOT_STATUS_OK && x > left && x < right && y > bottom;
}

/* 3. A lesson: the trainer rewards the robot for being in the right room or on the way to its door. */
static int teach(goodbot *robot, const char *command, int left, int right) {
    TRY(goodbot_home_place(robot, "agent0", 4, 2));
    TRY(goodbot_hear(robot, command));
    for (int steps = 0, rests = 0; steps < 100 && rests < 3; steps++) {
        uint8_t action = GOODBOT_NOOP;
        int32_t x0 = 0, x1 = 0, y0 = 0, y1 = 0;
        if (step(robot, &action)) return 1;
        TRY(goodbot_home_where(robot, "agent0", &x0, &y0));
        int there = is_in(robot, left, right, 4);
        TRY(goodbot_acted(robot, action));
        TRY(goodbot_home_where(robot, "agent0", &x1, &y1));
        int door = (left + right) / 2, far0 = x0 > door ? x0 - door : door - x0, far1 = x1 > door ? x1 - door : door - x1;
        int good = there ? action == GOODBOT_NOOP : far1 < far0 || (far1 == far0 && y1 > y0);
        rests = there && action == GOODBOT_NOOP ? rests + 1 : 0;
        uint32_t evidence;
        /* This trainer has one button, for "good bot": not pressing it is told too. */
        TRY(goodbot_feedback(robot, good ? GOODBOT_REWARD : GOODBOT_NEUTRAL, &evidence));
        if (evidence != GOODBOT_EVIDENCE_USED) return 1;
    }
    TRY(goodbot_finish(robot, NULL));
    goodbot_status status;
    while ((status = goodbot_learn(robot, 100)) == GOODBOT_STATUS_WORKING) {
    }
    TRY(status);
    return 0;
}

/* 4. What it takes a command to mean. */
static int understands(goodbot *robot, const char *command, const char *meaning) {
    uint32_t task = 0;
    float probability = 0;
    char text[64];
    TRY(goodbot_home_place(robot, "agent0", 4, 2));
    TRY(goodbot_hear(robot, command));
    TRY(goodbot_most_likely(robot, &task));
    TRY(goodbot_task_probability(robot, task, &probability));
    TRY(goodbot_task_text(robot, task, text, sizeof text));
    printf("\"%s\": %s, %d %%\n", command, text, (int)(probability * 100));
    TRY(goodbot_forget(robot));
    return strcmp(text, meaning) != 0;
}

int main(void) {
    goodbot_capacities capacities;
    goodbot *robot = NULL, *other = NULL;
    size_t length = 0;
    if (goodbot_api_version() != GOODBOT_API_VERSION) return 1;
    TRY(goodbot_preset(GOODBOT_SMALL, &capacities));
    TRY(goodbot_init_home(first_memory, sizeof first_memory, &capacities, &robot));
    if (describe(robot)) return 1;
    for (int round = 0; round < 2; round++) {
        if (teach(robot, "go to the green room", 0, 4)) return 1;
        if (teach(robot, "go to the blue room", 4, 8)) return 1;
    }
    if (understands(robot, "go to the green room", "agentInRoom(agent0,room1)")) return 1;

    /* In parts, so that a control loop goes on meanwhile. */
    goodbot_status status;
    goodbot_saving saving;
    TRY(goodbot_begin_saving(&saving, model, sizeof model));
    while ((status = goodbot_save_on(robot, &saving, 16, &length)) == GOODBOT_STATUS_WORKING) {
    }
    TRY(status);
    printf("saved: %d bytes\n", (int)length);
    TRY(goodbot_init_home(second_memory, sizeof second_memory, &capacities, &other));
    goodbot_restoring restoring;
    TRY(goodbot_begin_restoring(&restoring, model, length));
    while ((status = goodbot_restore_on(other, &restoring, 16)) == GOODBOT_STATUS_WORKING) {
    }
    TRY(status);
    while ((status = goodbot_learn(other, 100)) == GOODBOT_STATUS_WORKING) {
    }
    TRY(status);
    if (describe(other)) return 1;
    if (understands(other, "go to the green room", "agentInRoom(agent0,room1)")) return 1;
    if (understands(other, "go to the blue room", "agentInRoom(agent0,room2)")) return 1;

    /* Misuse is answered by a status. */
    if (goodbot_hear(NULL, "go") != GOODBOT_STATUS_NULL) return 1;
    if (goodbot_hear(other, " ") != GOODBOT_STATUS_EMPTY_COMMAND) return 1;
    uint32_t evidence;
    if (goodbot_feedback(other, GOODBOT_REWARD, &evidence) != GOODBOT_STATUS_NO_SESSION) return 1;
    model[length / 2] ^= 1;
    if (goodbot_restore(other, model, length) != GOODBOT_STATUS_BAD_MODEL) return 1;
    if (goodbot_init_home(second_memory, 100, &capacities, &other) != GOODBOT_STATUS_MEMORY) return 1;
    printf("home: passed\n");
    return 0;
}
