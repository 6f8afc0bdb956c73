# layout.awk: reads the preprocessed public headers (cc -E -P) and writes the list that layout.c expands:
# BEGIN, FIELD and END of every struct, VALUE of every enumerator, FUNCTION of every prototype.
{ text = text " " $0 }

# Prints the FIELD lines of one member declaration.
function members(owner, declaration,    names, count, i, type, name) {
    gsub(/^ +| +$/, "", declaration)
    if (declaration == "") return
    if (match(declaration, /\(\*[a-z0-9_]+\)/)) {
        name = substr(declaration, RSTART + 2, RLENGTH - 3)
        printf "FIELD(%s, %s, \"%s\")\n", owner, name, declaration
        return
    }
    count = split(declaration, names, /, */)
    for (i = 1; i <= count; i++) {
        name = names[i]
        sub(/\[.*/, "", name)
        match(name, /[A-Za-z0-9_]+ *$/)
        if (i == 1) type = substr(name, 1, RSTART - 1)
        name = substr(name, RSTART, RLENGTH)
        gsub(/ +$/, "", type)
        gsub(/ /, "", name)
        printf "FIELD(%s, %s, \"%s\")\n", owner, name, type (names[i] ~ /\[/ ? substr(names[i], index(names[i], "[")) : "")
    }
}

END {
    gsub(/[ \t]+/, " ", text)
    rest = text
    while (match(rest, /(typedef struct tahr_[a-z0-9_]+|enum) \{[^}]*\}/)) {
        block = substr(rest, RSTART, RLENGTH)
        rest = substr(rest, RSTART + RLENGTH)
        open = index(block, "{")
        body = substr(block, open + 1, length(block) - open - 1)
        if (block ~ /^enum/) {
            count = split(body, parts, ",")
            for (i = 1; i <= count; i++)
                if (match(parts[i], /TAHR_[A-Z0-9_]+/)) printf "VALUE(%s)\n", substr(parts[i], RSTART, RLENGTH)
            continue
        }
        split(block, words, " ")
        printf "BEGIN(%s)\n", words[3]
        count = split(body, parts, ";")
        for (i = 1; i <= count; i++) members(words[3], parts[i])
        printf "END(%s)\n", words[3]
    }
    count = split(text, parts, /[;}]/)
    for (i = 1; i <= count; i++) {
        if (!sub(/.*visibility\("default"\)\)\) /, "", parts[i])) continue
        printf "FUNCTION(\"%s\")\n", parts[i]
    }
}
