// Arduino's serial line, for this machine: it reads standard input.
#pragma once
#include <cstdint>
#include <cstdio>
#include <string>

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
    void print(uint32_t number) { std::printf("%lu", static_cast<unsigned long>(number)); }
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
}
