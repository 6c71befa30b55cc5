// A program that includes a component's door, and does nothing.
#include DOOR

int main() {}
