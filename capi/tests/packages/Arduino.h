// Arduino's serial line, clock and pins, for this machine: the line reads standard input, and a person at the button wants the lift on the
// top floor, looks at the floors that it tells, and presses after each right move.
#pragma once
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

struct Person {
    static constexpr int goal = 3;
    int floor = 0;
    bool is_content = false;
    void sees(int now) {
        is_content = std::abs(goal - now) < std::abs(goal - floor) || (now == goal && floor == goal);
        floor = now;
    }
};

inline Person person;

enum { LOW, HIGH, INPUT_PULLUP };
inline void pinMode(int, int) {}
inline int digitalRead(int) { return person.is_content ? LOW : HIGH; }
inline unsigned long millis() {
    static unsigned long now = 0;
    return now += 100;
}

struct SerialLine {
    int next = std::getchar();
    void begin(long) {}
    int available() const { return next != EOF; }
    int read() {
        int letter = next;
        next = std::getchar();
        return letter;
    }
    void print(const char *text) { std::fputs(text, stdout); }
    void print(int number) { std::printf("%d", number); }
    void print(uint32_t number) {
        person.sees(static_cast<int>(number));
        std::printf("%lu", static_cast<unsigned long>(number));
    }
    template <class T> void println(T value) {
        print(value);
        std::putchar('\n');
    }
};

inline SerialLine Serial;

void setup();
void loop();

int main() {
    setup();
    while (Serial.available()) loop();
    // What goes on by the clock alone.
    for (int more = 0; more < 10000; more++) loop();
}
