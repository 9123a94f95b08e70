/* A robot that is talked to: it is taught 16 commands, then it hears what people say next. */
#include <goodbot.h>
#include <stdio.h>
#include <string.h>

GOODBOT_ALIGNED static unsigned char memory[GOODBOT_SMALL_BYTES];

/* Words about commands, in the language that is spoken: a part of the output of `goodbot example closed-words`. */
static const char closed_words[] = "negation: not don't never\n"
                                   "connective: and then\n"
                                   "stop: stop wait\n"
                                   "praise: good well\n"
                                   "blame: bad wrong\n"
                                   "yes: yes okay\n"
                                   "no: no\n"
                                   "again: again back\n"
                                   "back: back\n"
                                   "pronoun: it there\n"
                                   "there: there\n"
                                   "greeting: hello thanks\n"
                                   "asking: where what is\n"
                                   "polite: please could you the one\n"
                                   "toward: to into\n"
                                   "meant: meant mean\n";

#define TRY(call)                                                                                                                          \
    do {                                                                                                                                   \
        goodbot_status tried = (call);                                                                                                     \
        if (tried != GOODBOT_STATUS_OK) {                                                                                                  \
            printf("%s: %s\n", #call, goodbot_status_text(tried));                                                                         \
            return 1;                                                                                                                      \
        }                                                                                                                                  \
    } while (0)

/* 1. The home, as in home.c: three rooms, two doors. */
static int describe(goodbot *robot) {
    TRY(goodbot_home_begin(robot));
    TRY(goodbot_home_room(robot, "room0", 0, 0, 8, 4, "red"));
    TRY(goodbot_home_room(robot, "room1", 0, 4, 4, 8, "green"));
    TRY(goodbot_home_room(robot, "room2", 4, 4, 8, 8, "blue"));
    TRY(goodbot_home_door(robot, "door0", 2, 4, 2, 4));
    TRY(goodbot_home_door(robot, "door1", 6, 4, 6, 4));
    TRY(goodbot_home_agent(robot, "agent0", 4, 2));
    TRY(goodbot_home_build(robot));
    return 0;
}

static int step(goodbot *robot, uint8_t *action) {
    goodbot_status status;
    while ((status = goodbot_plan(robot, 50)) == GOODBOT_STATUS_WORKING) {
    }
    TRY(status);
    TRY(goodbot_decide(robot, action, NULL));
    TRY(goodbot_acted(robot, *action));
    return 0;
}

/* 2. A lesson: the trainer knows the task, and praises each step that brings the robot nearer to the door of its room. */
static int teach(goodbot *robot, const char *wording, const char *color, int door) {
    char command[64];
    (void)snprintf(command, sizeof command, wording, color);
    TRY(goodbot_home_place(robot, "agent0", 4, 2));
    TRY(goodbot_hear(robot, command));
    for (int steps = 0, rests = 0; steps < 100 && rests < 2; steps++) {
        uint8_t action = GOODBOT_NOOP;
        int32_t x0 = 0, x1 = 0, y0 = 0, y1 = 0;
        uint32_t evidence;
        TRY(goodbot_home_where(robot, "agent0", &x0, &y0));
        if (step(robot, &action)) return 1;
        TRY(goodbot_home_where(robot, "agent0", &x1, &y1));
        int there = y0 > 4 && (x0 < 4) == (door < 4);
        int far0 = x0 > door ? x0 - door : door - x0, far1 = x1 > door ? x1 - door : door - x1;
        int good = there ? action == GOODBOT_NOOP : far1 < far0 || (far1 == far0 && y1 > y0);
        rests = there && action == GOODBOT_NOOP ? rests + 1 : 0;
        TRY(goodbot_feedback(robot, good ? GOODBOT_REWARD : GOODBOT_PUNISH, &evidence));
    }
    TRY(goodbot_finish(robot, NULL));
    goodbot_status status;
    while ((status = goodbot_learn(robot, 1000)) == GOODBOT_STATUS_WORKING) {
    }
    TRY(status);
    return 0;
}

/* 3. Other work between two parts of listening: here the parts are counted. A robot that hears no end stops listening. */
static bool count(void *context) {
    unsigned *left = context;
    return *left > 0 && (*left)-- > 0;
}

/* 4. The verdict on an utterance, or on the rest of one. */
static int hears(goodbot *robot, const char *said, int is_rest, goodbot_verdict verdict, const char *task, goodbot_listened *listened) {
    char text[64];
    unsigned left = 10000;
    TRY((is_rest ? goodbot_listen_on : goodbot_listen)(robot, said, closed_words, count, &left, listened));
    TRY(goodbot_task_text(robot, listened->task, text, sizeof text));
    printf("\"%s\": verdict %d, %s, %d %%, %u parts\n", said, (int)listened->verdict, text, (int)(listened->probability * 100),
           10000 - left);
    return listened->verdict != verdict || (task && strcmp(text, task) != 0);
}

/* 5. The robot does what it heard, and remembers it. */
static int follow(goodbot *robot, uint32_t task) {
    uint8_t action = GOODBOT_NOOP;
    for (int steps = 0; steps < 50; steps++) {
        if (step(robot, &action)) return 1;
        if (action == GOODBOT_NOOP) break;
    }
    TRY(goodbot_remember(robot, task));
    TRY(goodbot_forget(robot));
    return 0;
}

static int asks(goodbot *robot, const char *words, goodbot_said_kind kind) {
    goodbot_said_kind said;
    int32_t answer = 0;
    TRY(goodbot_said(robot, words, closed_words, &said, &answer));
    printf("\"%s\": asks for %d\n", words, (int)said);
    return said != kind;
}

int main(void) {
    static const char *const wordings[] = {"go to the %s room", "walk to the %s room", "go into the %s room", "move to the %s room"};
    goodbot_capacities capacities;
    goodbot *robot = NULL;
    goodbot_listened heard;
    uint8_t action;
    TRY(goodbot_preset(GOODBOT_SMALL, &capacities));
    TRY(goodbot_init_home(memory, sizeof memory, &capacities, &robot));
    if (describe(robot)) return 1;
    for (int lesson = 0; lesson < 16; lesson++) {
        if (teach(robot, wordings[lesson / 2 % 4], lesson % 2 ? "green" : "blue", lesson % 2 ? 2 : 6)) return 1;
    }
    TRY(goodbot_home_place(robot, "agent0", 4, 2));

    /* Several commands: the first, and the rest where it leads to. */
    const char *both = "go to the green room and then to the blue room";
    if (hears(robot, both, 0, GOODBOT_VERDICT_SURE, "agentInRoom(agent0,room1)", &heard)) return 1;
    if (heard.taken_for != GOODBOT_TAKEN_FOR_SEVERAL || heard.rest == GOODBOT_NOWHERE) return 1;
    if (follow(robot, heard.task)) return 1;
    if (hears(robot, both + heard.rest, 1, GOODBOT_VERDICT_SURE, "agentInRoom(agent0,room2)", &heard)) return 1;
    if (follow(robot, heard.task)) return 1;

    /* A remembered task, a task that is done already, a negated one, and an utterance that is no command. */
    if (hears(robot, "go back", 0, GOODBOT_VERDICT_SURE, "agentInRoom(agent0,room1)", &heard)) return 1;
    TRY(goodbot_forget(robot));
    if (hears(robot, "go there", 0, GOODBOT_VERDICT_DONE, "agentInRoom(agent0,room2)", &heard)) return 1;
    TRY(goodbot_forget(robot));
    if (hears(robot, "don't go to the green room", 0, GOODBOT_VERDICT_DONE, "!agentInRoom(agent0,room1)", &heard)) return 1;
    TRY(goodbot_forget(robot));
    if (hears(robot, "where is my hat", 0, GOODBOT_VERDICT_NONE, NULL, &heard)) return 1;
    TRY(goodbot_forget(robot));

    /* The trainer's voice, and a correction. */
    if (asks(robot, "go to the green room", GOODBOT_SAID_KIND_COMMAND)) return 1;
    TRY(goodbot_home_place(robot, "agent0", 4, 2));
    if (hears(robot, "go to the green room", 0, GOODBOT_VERDICT_SURE, "agentInRoom(agent0,room1)", &heard)) return 1;
    if (step(robot, &action)) return 1;
    if (asks(robot, "well done", GOODBOT_SAID_KIND_GOOD) || asks(robot, "stop", GOODBOT_SAID_KIND_STOP)) return 1;
    if (asks(robot, "no, the blue one", GOODBOT_SAID_KIND_CORRECTION)) return 1;
    TRY(goodbot_correct(robot, "no, the blue one", closed_words));
    uint32_t task = 0;
    char text[64];
    TRY(goodbot_most_likely(robot, &task));
    TRY(goodbot_task_text(robot, task, text, sizeof text));
    if (strcmp(text, "agentInRoom(agent0,room2)") != 0) return 1;
    TRY(goodbot_forget(robot));

    /* Misuse is answered by a status. */
    unsigned none = 0;
    if (goodbot_listen(robot, "go", closed_words, count, &none, &heard) != GOODBOT_STATUS_STOPPED) return 1;
    if (goodbot_listen(robot, "go", "colour: red", NULL, NULL, &heard) != GOODBOT_STATUS_CLOSED_WORDS) return 1;
    if (goodbot_listen(robot, "go", NULL, NULL, NULL, NULL) != GOODBOT_STATUS_NULL) return 1;
    if (goodbot_correct(robot, "no", NULL) != GOODBOT_STATUS_NO_SESSION) return 1;
    printf("talk: passed\n");
    return 0;
}
