% What matlab/+trochoid answers, beside what the program says of the same cases.
1;

function same(got, want, what)
  if ~isequaln(got, want)
    error('%s: %s is not %s', what, disp(got), disp(want));
  end
end

function text = refused(ask)
  text = '';
  try
    ask();
  catch wrong
    same(wrong.identifier, 'trochoid:input', 'identifier');
    text = wrong.message;
  end
end

root = getenv('TROCHOID_ROOT');
addpath(fullfile(root, 'matlab'));
own = tempname();
mkdir(own);
cd(own);

% A struct is the case file of the same keys.
tool = struct('teeth', 2, 'diameter_mm', 8, 'helix_deg', 30);
cut = struct('engagement', 'slot', 'axial_depth_mm', 2, 'feed_per_tooth_mm', 0.04, ...
             'spindle_rpm', 875);
law = struct('K_tc_MPa', 2000, 'K_rc_MPa', 900, 'K_ac_MPa', 300, 'K_te_N_per_mm', 10, ...
             'K_re_N_per_mm', 8, 'K_ae_N_per_mm', 1.5);
made = struct('title', 'a "case"', 'tool', tool, 'cut', cut, 'force', law, ...
              'runout', struct('radial_offsets_mm', [0, -0.008]));
written = fopen('case.toml', 'w');
fprintf(written, ['title = "a \\"case\\""\n[tool]\nteeth = 2\ndiameter_mm = 8\nhelix_deg = 30\n' ...
  '[cut]\nengagement = "slot"\naxial_depth_mm = 2\nfeed_per_tooth_mm = 0.04\nspindle_rpm = 875\n' ...
  '[force]\nK_tc_MPa = 2000\nK_rc_MPa = 900\nK_ac_MPa = 300\n' ...
  'K_te_N_per_mm = 10\nK_re_N_per_mm = 8\nK_ae_N_per_mm = 1.5\n' ...
  '[runout]\nradial_offsets_mm = [0, -0.008]\n']);
fclose(written);
of_struct = trochoid.simulate(made);
of_file = trochoid.simulate('case.toml', 'output', 'kept');
same(of_struct.result, of_file.result, 'result of a struct');
same(of_struct.folder, '', 'folder that nobody asked for');
same(exist(fullfile('kept', 'summary.json'), 'file'), 2, 'folder that was asked for');
same(exist(fullfile('kept', 'report.html'), 'file'), 0, 'report that nobody asked for');
same(of_struct.ok, true, 'ok');
same(isempty(strfind(of_struct.text, 'results:')), true, 'a folder that is gone');
same(isempty(strfind(of_file.text, 'results: kept')), false, 'a folder that is kept');
force = of_struct.tables.forces;
peak = max(hypot(force.Fx_N, force.Fy_N));
same(abs(peak / of_struct.result.peak_xy_N - 1) < 1e-12, true, 'peak of the table');

% In place of what the case says, and files from the current folder.
half = made;
half.cut.axial_depth_mm = 1;
half.cut.spindle_rpm = 900;
settings = {'cut.axial_depth_mm=1', 'cut.spindle_rpm=900'};
want = trochoid.simulate(half);
for given = {settings, settings'}  % in a row, in a column
  got = trochoid.simulate(made, 'set', given{1});
  same(got.result, want.result, 'settings');
end
copyfile(fullfile(root, 'examples', 'st52_slot', 'record.csv'), 'record.csv');
measured = struct('tool', tool, 'cut', cut, ...
                  'dynamometer', struct('axes', {{'-x', '-y', '-z'}}), ...
                  'measurement', struct('file', 'record.csv'), ...
                  'identify', struct('chip_models', {{'trochoidal'}}, 'runout', 'offsets', ...
                                     'channel_offsets', 'fit'));
found = trochoid.identify(measured);
example = trochoid.identify(fullfile(root, 'examples', 'st52_slot', 'case.toml'), ...
  'set', {'identify.chip_models=["trochoidal"]'});
same(found.result.fits.coefficients, example.result.fits.coefficients, 'coefficients');
same(isfield(found.tables, 'fitted'), true, 'fitted.csv');

% What the page shows finds what the record was made with.
blocks = regexp(fileread(fullfile(root, 'docs', 'matlab.md')), '```matlab\n(.*?)```', 'tokens');
evalc(strrep(blocks{2}{1}, 'plot(', 'horzcat('));
same(found.ok && K_tc.low < 2620 && 2620 < K_tc.high, true, 'the example of the page');

% Texts in a table, and names that are none of MATLAB.
over = struct();
over.over = containers.Map('cut.spindle_rpm', struct('values', [800, 900]));
over.take = {'result.peak_xy_N'};
over.command = 'simulate';
swept = trochoid.sweep(setfield(made, 'sweep', over));
same(swept.tables.sweep.cut_spindle_rpm, [800; 900], 'swept key');
same(swept.tables.sweep.status, {'ok'; 'ok'}, 'texts');

% Every mistake at once, none of them as an answer.
wrong = made;
wrong.tool.teeth = 0;
wrong.cut.feed_mm = 1;
text = refused(@() trochoid.simulate(wrong));
same(~isempty(strfind(text, 'tool.teeth = 0')) && ~isempty(strfind(text, 'cut.feed_mm')), ...
     true, 'mistakes');
same(~isempty(refused(@() trochoid.simulate(made, 'sett', {}))), true, 'unknown option');

cd(root);
confirm_recursive_rmdir(false);
rmdir(own, 's');
disp('answers ok');
