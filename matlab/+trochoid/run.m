function answer = run(command, case_, varargin)
%RUN  Answer a case by a command of the program trochoid.
%
%   answer = trochoid.run(command, case_)
%   answer = trochoid.run(command, case_, name, value, ...)
%
%   command  name of a command: 'identify', 'simulate', ...
%   case_    name of a case file, or a struct of its tables:
%            struct('tool', struct('teeth', 2, ...), 'cut', struct(...)); a table that
%            may stand several times is a struct array, and one whose keys are no names
%            of MATLAB (`over` of [sweep]) a containers.Map. File names in a struct
%            count from the current folder.
%
%   names and values:
%   'set'      cell array of texts KEY=VALUE, in place of what the case says
%   'output'   folder for the results; else a temporary one, which is deleted again
%   'report'   true: write report.html too (only with 'output')
%   'options'  cell array of further options, as on the command line
%
%   answer.ok        false: there is no good answer, and answer.message says why
%   answer.message   the headline
%   answer.warnings  struct array of code and message
%   answer.result    the numbers, named as on the page docs/formats/results.md; a number
%                    that cannot be known is [], within a list NaN
%   answer.tables    the columns of the CSV files: answer.tables.fitted.Fx_N. What is no
%                    name of MATLAB has _ in its place: cut.spindle_rpm, cut_spindle_rpm
%   answer.text      what the program prints
%   answer.folder    of the results; empty where they were deleted
%
%   Errors: trochoid:input, the input is wrong, with every mistake; trochoid:program, the
%   program is not there or broke down. The program is the one that the environment
%   variable TROCHOID names, else `trochoid` of the search path.
asked = struct('set', {{}}, 'output', '', 'report', false, 'options', {{}});
for i = 1:2:numel(varargin) - 1
  name = char(varargin{i});
  if ~isfield(asked, name)
    error('trochoid:input', 'no such option: %s', name);
  end
  asked.(name) = varargin{i + 1};
end
if mod(numel(varargin), 2) == 1
  error('trochoid:input', 'the last option has no value');
end

own = tempname();
mkdir(own);
tidy = onCleanup(@() remove(own));
folder = char(asked.output);
if isempty(folder)
  folder = fullfile(own, 'answer');
end
words = {command, '-', '-o', folder};
input = fullfile(own, 'case.toml');
if isstruct(case_)
  write_text(input, case_text(case_));
else
  words{2} = char(case_);
  write_text(input, '');
end

if isempty(asked.output) || ~asked.report
  words{end + 1} = '--no-report';
end
for one = row_of(asked.set)
  words = [words, {'--set', one{1}}];  %#ok<AGROW>
end
words = [words, row_of(asked.options)];
[code, said, wrong] = call(words, input, own);
if code == 2
  error('trochoid:input', '%s', strtrim(wrong));
elseif code == 127 || code == 9009  % of the shell, and of cmd
  error('trochoid:program', ['there is no program trochoid: put it into a folder of the ' ...
        'search path, or name it by setenv(''TROCHOID'', FILE)']);
elseif code > 2 || ~exist(fullfile(folder, 'summary.json'), 'file')
  error('trochoid:program', 'exit code %d: %s', code, strtrim(wrong));
end

summary = jsondecode(fileread(fullfile(folder, 'summary.json')));
answer = struct('ok', strcmp(summary.status, 'ok'), 'message', summary.message, ...
                'warnings', {summary.warnings}, 'result', {summary.result}, ...
                'tables', {tables_of(folder)}, 'text', said, 'folder', '');
if isempty(asked.output)
  answer.text = regexprep(said, '\n?results: [^\n]*\n$', '');  % of a folder that goes
else
  answer.folder = folder;
end
end

function list = row_of(texts)
list = reshape(cellstr(texts), 1, []);
end

function [code, said, wrong] = call(words, input, folder)
% The exit code of the program, what it prints, and what it says of mistakes.
program = getenv('TROCHOID');
if isempty(program)
  program = 'trochoid';
end
line = quoted(program);
for i = 1:numel(words)
  line = [line, ' ', quoted(words{i})];  %#ok<AGROW>
end
out = fullfile(folder, 'out.txt');
err = fullfile(folder, 'err.txt');
line = [line, ' < ', quoted(input), ' > ', quoted(out), ' 2> ', quoted(err)];
if ispc
  line = ['"', line, '"'];  % cmd takes the first and the last quote away
else
  line = ['env -u LD_LIBRARY_PATH ', line];  % MATLAB has libraries of its own there
end
code = system(line);
said = '';
wrong = '';
if exist(out, 'file')
  said = fileread(out);
end
if exist(err, 'file')
  wrong = fileread(err);
end
end

function text = quoted(word)
if ispc
  text = ['"', word, '"'];
else
  text = ['''', strrep(word, '''', '''\'''''''), ''''];
end
end

function remove(folder)
if exist('OCTAVE_VERSION', 'builtin')
  confirm_recursive_rmdir(false, 'local');
end
rmdir(folder, 's');
end

function write_text(file, text)
handle = fopen(file, 'w');
fwrite(handle, text);
fclose(handle);
end

function tables = tables_of(folder)
tables = struct();
for file = dir(fullfile(folder, '*.csv'))'
  [~, name] = fileparts(file.name);
  tables.(matlab.lang.makeValidName(name)) = read_table(fullfile(folder, file.name));
end
end

function table = read_table(file)
% The columns of a CSV file of the program; a column of texts is in quotes.
handle = fopen(file);
closing = onCleanup(@() fclose(handle));
names = matlab.lang.makeUniqueStrings( ...
    matlab.lang.makeValidName(strsplit(fgetl(handle), ',')));
start = ftell(handle);
first = fgetl(handle);
kinds = repmat({'%f'}, 1, numel(names));
if ischar(first)
  cells = regexp(first, '("[^"]*"|[^,]*)(,|$)', 'tokens');
  for i = 1:min(numel(cells), numel(names))
    if strncmp(cells{i}{1}, '"', 1)
      kinds{i} = '%q';
    end
  end
end
fseek(handle, start, 'bof');
columns = textscan(handle, strjoin(kinds, ''), 'Delimiter', ',', 'EmptyValue', NaN);
table = struct();
for i = 1:numel(names)
  table.(names{i}) = columns{i};
end
end

function text = case_text(tables)
% A case file of a struct: what stands above all tables, then the tables.
text = '';
names = fieldnames(tables)';
for name = names
  if ~isstruct(tables.(name{1}))
    text = [text, name{1}, ' = ', toml(tables.(name{1})), newline];  %#ok<AGROW>
  end
end
for name = names
  table = tables.(name{1});
  if ~isstruct(table)
    continue
  end
  many = any(strcmp(name{1}, {'measurement', 'pass', 'surface_measurement', 'mode', ...
                              'measured_frf'}));
  for i = 1:numel(table)
    if many
      text = [text, newline, '[[', name{1}, ']]', newline];  %#ok<AGROW>
    else
      text = [text, newline, '[', name{1}, ']', newline];  %#ok<AGROW>
    end
    for key = fieldnames(table)'
      value = table(i).(key{1});
      if ~isempty(value)
        text = [text, key{1}, ' = ', toml(value), newline];  %#ok<AGROW>
      end
    end
  end
end
end

function text = toml(value)
% A value as TOML: texts, truths, numbers, lists, tables within.
if ischar(value)
  text = ['"', strrep(strrep(value, '\', '\\'), '"', '\"'), '"'];
elseif isa(value, 'string') && isscalar(value)
  text = toml(char(value));
elseif isa(value, 'containers.Map')
  parts = cellfun(@(key) [toml(key), ' = ', toml(value(key))], keys(value), ...
                  'UniformOutput', false);
  text = ['{ ', strjoin(parts, ', '), ' }'];
elseif isstruct(value)
  parts = cellfun(@(key) [key, ' = ', toml(value.(key))], fieldnames(value)', ...
                  'UniformOutput', false);
  text = ['{ ', strjoin(parts, ', '), ' }'];
elseif iscell(value) || isa(value, 'string')
  parts = cellfun(@toml, cellstr_of(value), 'UniformOutput', false);
  text = ['[', strjoin(parts, ', '), ']'];
elseif ~isscalar(value)
  rows = size(value, 1);
  if rows > 1 && size(value, 2) > 1
    parts = arrayfun(@(i) toml(value(i, :)), 1:rows, 'UniformOutput', false);
  else
    parts = arrayfun(@toml, value(:)', 'UniformOutput', false);
  end
  text = ['[', strjoin(parts, ', '), ']'];
elseif islogical(value)
  if value
    text = 'true';
  else
    text = 'false';
  end
elseif value == round(value) && abs(value) < 1e15
  text = sprintf('%d', value);
else
  text = sprintf('%.17g', value);
end
end

function list = cellstr_of(value)
if iscell(value)
  list = value(:)';
else
  list = cellstr(value(:)');
end
end
