// Carries precompiled headers (TurnscanPrecompiled.cmake).
int main() { return 0; }
