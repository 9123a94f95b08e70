/* A robot of one's own: a lift with four floors that learns the names people have for them. */
#include <goodbot.h>
#include <stdio.h>
#include <string.h>

#define FLOORS 4
enum { UP, DOWN };

GOODBOT_ALIGNED static unsigned char memory[GOODBOT_TINY_TABLE_BYTES];

#define TRY(call)                                                                                                                          \
    do {                                                                                                                                   \
        goodbot_status tried = (call);                                                                                                     \
        if (tried != GOODBOT_STATUS_OK) {                                                                                                  \
            puts(#call), puts(goodbot_status_text(tried));                                                                                 \
            return 1;                                                                                                                      \
        }                                                                                                                                  \
    } while (0)

/* 1. Classes, attributes, propositions, objects, actions. */
static const char *const classes[] = {"lift", "floor"};
static const goodbot_carrier carriers[] = {{1, "floorIs"}};
static const goodbot_attribute attributes[] = {{"use", carriers, 1}};
static const goodbot_proposition propositions[] = {{"liftAtFloor", {0, 1, 0}, 2}};
static const goodbot_object objects[] = {
    {0, "lift0", {NULL}},
    {1, "floor0", {"garage"}},
    {1, "floor1", {"shop"}},
    {1, "floor2", {"office"}},
    {1, "floor3", {"roof"}},
};
static const goodbot_action actions[] = {{"up", 1}, {"down", 1}};
static const char *const tasks[] = {"liftAtFloor(?l, ?f)"};

/* 2. What the actions do: a table of steps, or a function like this one. The state is the floor. */
static bool move(void *context, uint32_t state, uint8_t action, uint32_t *next) {
    (void)context;
    if (action == UP && state + 1 < FLOORS) return *next = state + 1, true;
    if (action == DOWN && state > 0) return *next = state - 1, true;
    return false;
}

static const uint16_t steps[FLOORS * 2] = {1, GOODBOT_CANNOT, 2, 0, 3, 1, GOODBOT_CANNOT, 2};

/* 3. Which propositions hold. Floor n is object n + 1. */
static bool holds(void *context, uint32_t state, uint8_t proposition, const uint8_t *arguments) {
    (void)context;
    return proposition == 0 && arguments[1] == state + 1;
}

static int lesson(goodbot *robot, const char *command, uint32_t from, uint32_t target) {
    goodbot_status status;
    TRY(goodbot_table_set_state(robot, from));
    TRY(goodbot_hear(robot, command));
    for (int turns = 0, rests = 0; turns < 50 && rests < 3; turns++) {
        uint8_t action = GOODBOT_NOOP;
        uint32_t floor = 0;
        while ((status = goodbot_plan(robot, 10)) == GOODBOT_STATUS_WORKING) {
        }
        TRY(status);
        TRY(goodbot_decide(robot, &action, NULL));
        TRY(goodbot_table_state(robot, &floor));
        int right = floor < target ? action == UP : floor > target ? action == DOWN : action == GOODBOT_NOOP;
        rests = floor == target && right ? rests + 1 : 0;
        TRY(goodbot_acted(robot, action));
        uint32_t evidence;
        TRY(goodbot_feedback(robot, right ? GOODBOT_REWARD : GOODBOT_PUNISH, &evidence));
        if (evidence != GOODBOT_EVIDENCE_USED) return 1;
    }
    TRY(goodbot_finish(robot, NULL));
    while ((status = goodbot_learn(robot, 100)) == GOODBOT_STATUS_WORKING) {
    }
    TRY(status);
    return 0;
}

static int train(goodbot_table *table) {
    goodbot_capacities capacities;
    goodbot *robot = NULL;
    uint32_t task = 0;
    char text[40];
    TRY(goodbot_preset(GOODBOT_TINY, &capacities));
    TRY(goodbot_init_table(memory, sizeof memory, &capacities, table, &robot));
    TRY(goodbot_seed(robot, 7));
    for (int round = 0; round < 2; round++) {
        if (lesson(robot, "up to the roof", 0, 3)) return 1;
        if (lesson(robot, "take me shopping", 3, 1)) return 1;
        if (lesson(robot, "to the garage", 2, 0)) return 1;
    }
    TRY(goodbot_table_set_state(robot, 0));
    TRY(goodbot_hear(robot, "take me shopping"));
    TRY(goodbot_most_likely(robot, &task));
    TRY(goodbot_task_text(robot, task, text, sizeof text));
    puts(text);
    if (goodbot_task_text(robot, task, text, 5) != GOODBOT_STATUS_BUFFER) return 1;
    TRY(goodbot_task_text(robot, task, text, sizeof text));
    static const char meant[] = "liftAtFloor(lift0,floor1)";
    return memcmp(text, meant, sizeof meant) != 0;
}

int main(void) {
    goodbot_table table = {
        .classes = classes, .class_count = 2, .attributes = attributes, .attribute_count = 1,
        .propositions = propositions, .proposition_count = 1, .objects = objects, .object_count = 5,
        .actions = actions, .action_count = 2, .tasks = tasks, .task_count = 1,
        .state_count = FLOORS, .start = 0, .step = move, .holds = holds,
    };
    if (train(&table)) return 1;
    table.next = steps;
    table.step = NULL;
    if (train(&table)) return 1;
    puts("lift: passed");
    return 0;
}
