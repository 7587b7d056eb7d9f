# What ./dev stress found: awk -v goal=N -v whole=1 -f report.awk docs/stability.md tests.xml
#
# Reads the rows of docs/stability.md, whose tests stand in backticks with * for any letters, and what tests told (tests/stress/worst_case.h)
# from a report in JUnit's form. Prints the worst cases by row and the cases tested by unit. Of a test's parameters the largest number counts.
# Exits with 1 where fewer samples than `goal` were tested or a row told nothing, if the suite ran as a whole.

function pattern_of(glob) {
    gsub(/\./, "\\.", glob)
    gsub(/\*/, ".*", glob)
    return "^" glob "$"
}

# Suite.Test of Instances/Suite.Test/Parameter.
function test_of(name,    parts, count, i) {
    count = split(name, parts, "/")
    for (i = 1; i <= count; ++i)
        if (index(parts[i], ".") > 0) return parts[i]
    return name
}

function grouped(number,    text, rest) {
    text = sprintf("%.0f", number)
    rest = ""
    while (length(text) > 3) {
        rest = " " substr(text, length(text) - 2) rest
        text = substr(text, 1, length(text) - 3)
    }
    return text rest
}

NR == FNR {
    if ($0 !~ /^\| [0-9]+ \|/) next
    split($0, column, "|")
    row = column[2] + 0
    title[row] = column[3]
    gsub(/^ +| +$/, "", title[row])
    if (row > rows) rows = row
    rest = column[5]
    while (match(rest, /`[^`]+`/)) {
        pattern[row, ++patterns[row]] = pattern_of(substr(rest, RSTART + 1, RLENGTH - 2))
        rest = substr(rest, RSTART + RLENGTH)
    }
    next
}

/<testcase / {
    test = $0
    sub(/.*<testcase name="/, "", test)
    sub(/".*/, "", test)
    test = test_of(test)
}

/\[   TESTED \] / {
    line = $0
    sub(/.*\[   TESTED \] /, "", line)
    count = line + 0
    unit = line
    sub(/^[0-9]+ /, "", unit)
    if (!(unit in tested)) unit_at[++units] = unit
    tested[unit] += count
}

/\[    WORST \] / {
    line = $0
    sub(/.*\[    WORST \] /, "", line)
    gsub(/&quot;/, "\"", line)
    colon = index(line, ": ")
    name = substr(line, 1, colon - 1)
    value = substr(line, colon + 2)
    gsub(/^"|"$/, "", value)
    key = test SUBSEP name
    if (!(key in worst)) { order[++told] = key; worst[key] = value }
    else if (value + 0 > worst[key] + 0) worst[key] = value
}

END {
    print "Worst cases, by row of docs/stability.md:"
    for (row = 1; row <= rows; ++row) {
        printf "%3d  %s\n", row, title[row]
        found = 0
        for (i = 1; i <= told; ++i) {
            split(order[i], part, SUBSEP)
            for (p = 1; p <= patterns[row]; ++p) {
                if (part[1] !~ pattern[row, p]) continue
                printf "       %s %s: %s\n", part[1], part[2], worst[order[i]]
                shown[order[i]] = found = 1
                break
            }
        }
        if (!found) { print "       no test told a worst case"; ++silent }
    }
    print "Beside them:"
    for (i = 1; i <= told; ++i) {
        split(order[i], part, SUBSEP)
        if (!(order[i] in shown)) printf "       %s %s: %s\n", part[1], part[2], worst[order[i]]
    }
    print "Tested:"
    for (i = 1; i <= units; ++i)
        if (unit_at[i] != "samples") printf "  %18s  %s\n", grouped(tested[unit_at[i]]), unit_at[i]
    printf "  %18s  samples, each held against an oracle", grouped(tested["samples"])
    if (tested["samples"] >= goal) print ": the " grouped(goal) " that are asked for are reached"
    else print ": FEWER than the " grouped(goal) " that are asked for" (whole ? "" : " of the whole suite at full size")
    exit whole && (tested["samples"] < goal || silent > 0)
}
