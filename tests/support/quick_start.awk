# Prints the first ```c block of a Markdown file; with -v block=2 the second one; with -v want=output the first line
# that the README shows as the first block's output: a line of a later block that begins like what the program prints;
# with -v code=cpp of ```cpp blocks.
BEGIN { if (!block) block = 1; if (!code) code = "c" }
/^```/ {
    if (inside) inside = 0
    else { inside = 1; language = substr($0, 4); if (language == code) seen++ }
    next
}
inside && language == code && seen == block && want != "output" { print }
inside && language != code && seen && want == "output" && /^(walking|falling) at / { print; exit }
